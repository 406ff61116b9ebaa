#include "fitting/networks/tables.hpp"

#include <cmath>
#include <functional>

namespace shakebed::fitting::networks {

namespace {

using files::CsvTable;
using Row = std::vector<std::string>;

std::string text(double value) { return files::number_text(value); }
std::string text(std::size_t value) { return std::to_string(value); }
std::string text(int value) { return std::to_string(value); }
std::string text(bool value) { return value ? "1" : "0"; }

CsvTable networks_table(const Analysis& analysis) {
  CsvTable table({{"network", "1"},
                  {"grains", "1"},
                  {"contacts", "1"},
                  {"coordination", "1"},
                  {"extent", "length"},
                  {"mean_force", "force"},
                  {"strong_contacts", "1"},
                  {"strong_grains", "1"},
                  {"grains_with_strong_contact", "1"}});
  std::size_t number = 0;
  for (const ForceNetwork& network : analysis.networks.networks) {
    table.add_row({text(++number), text(network.grains.size()), text(network.contacts.size()),
                   text(network.coordination), text(network.extent), text(network.mean_force),
                   text(network.strong_contacts), text(network.strong_grains),
                   text(network.grains_with_strong_contact)});
  }
  return table;
}

CsvTable contacts_table(const Snapshot& snapshot, const Analysis& analysis) {
  CsvTable table({{"i", ""},
                  {"j", ""},
                  {"x_i", "length"},
                  {"y_i", "length"},
                  {"z_i", "length"},
                  {"x_j", "length"},
                  {"y_j", "length"},
                  {"z_j", "length"},
                  {"length", "length"},
                  {"normal_force", "force"},
                  {"f", "mean force"},
                  {"network", "1"},
                  {"strong", "1"},
                  {"first_pass", "1"}});
  std::size_t number = 0;
  for (const ForceNetwork& network : analysis.networks.networks) {
    ++number;
    for (const Index k : network.contacts) {
      const Contact& contact = snapshot.contacts[k];
      const int first = analysis.contacting.first_pass[k];
      Row row{std::to_string(snapshot.id[contact.i]), std::to_string(snapshot.id[contact.j])};
      for (const Index grain : {contact.i, contact.j}) {
        for (const double x : snapshot.position[grain]) row.push_back(text(x));
      }
      row.push_back(text(length(snapshot, contact)));
      row.push_back(text(contact.normal_force));
      row.push_back(text(contact.normal_force / analysis.networks.mean_force));
      row.push_back(text(number));
      row.push_back(text(contact.normal_force > network.mean_force));
      row.push_back(first > 0 ? text(first) : "");
      table.add_row(std::move(row));
    }
  }
  return table;
}

CsvTable passes_table(const Analysis& analysis) {
  CsvTable table({{"passes", "1"},
                  {"NP", "1"},
                  {"NE", "1"},
                  {"NT", "1"},
                  {"NE_rest", "1"},
                  {"missing", "1"},
                  {"tree_edges", "1"},
                  {"tree_length_mean", "length"},
                  {"tree_length_sd", "length"},
                  {"tree_length_longest", "length"},
                  {"captured_length_mean", "length"},
                  {"captured_length_sd", "length"},
                  {"captured_length_longest", "length"}});
  auto rows = analysis.contacting.passes;
  rows.push_back(analysis.contacting.network);
  for (const PassCounts& row : rows) {
    table.add_row({text(row.passes), text(row.NP), text(row.NE), text(row.NT), text(row.NE_rest),
                   text(row.missing), text(row.tree.count), text(row.tree.mean),
                   text(row.tree.standard_deviation), text(row.tree.longest),
                   text(row.captured.mean), text(row.captured.standard_deviation),
                   text(row.captured.longest)});
  }
  return table;
}

/// Calls visit(name of the set, its distribution) for every set of contacts.
void each_set(const Analysis& analysis,
              const std::function<void(const std::string&, const ForceDistribution&)>& visit) {
  visit("all", analysis.all);
  visit("largest", analysis.largest);
  for (std::size_t pass = 0; pass < analysis.by_pass.size(); ++pass) {
    visit("pass " + text(pass + 1), analysis.by_pass[pass]);
  }
}

CsvTable pdf_table(const Analysis& analysis) {
  CsvTable table({{"set", ""},
                  {"f_from", "mean force"},
                  {"f_to", "mean force"},
                  {"count", "1"},
                  {"P", "1/mean force"},
                  {"P_error", "1/mean force"},
                  {"P_histogram_fit", "1/mean force"},
                  {"P_likelihood_fit", "1/mean force"},
                  {"P_shifted_histogram_fit", "1/mean force"},
                  {"P_shifted_likelihood_fit", "1/mean force"}});
  each_set(analysis, [&](const std::string& set, const ForceDistribution& of) {
    const auto& histogram = of.histogram;
    for (std::size_t bin = 0; bin < histogram.bins(); ++bin) {
      const double from = histogram.edges[bin], to = histogram.edges[bin + 1];
      Row row{set,
              text(from),
              text(to),
              text(histogram.counts[bin]),
              text(histogram.density(bin)),
              text(histogram.density_error(bin))};
      for (const ForceFit* fit : {&of.by_histogram, &of.by_likelihood, &of.shifted_by_histogram,
                                  &of.shifted_by_likelihood}) {
        row.push_back(fit->good() ? text(fit->law.integral(from, to) / (to - from)) : "");
      }
      table.add_row(std::move(row));
    }
  });
  return table;
}

Row fit_row(const std::string& set, const std::string& form, const std::string& method,
            const ForceFit& fit) {
  Row row{set, form, method};
  if (!fit.good()) {
    row.resize(22);
    row.push_back(fit.failure);
    return row;
  }
  const double values[] = {fit.law.a, fit.law.b, fit.law.beta, fit.law.theta};
  for (std::size_t p = 0; p < 4; ++p) {
    row.push_back(text(values[p]));
    const double error = fit.standard_error(p);
    row.push_back(error > 0 ? text(error) : "");
  }
  for (std::size_t p = 0; p < 3; ++p) {
    for (std::size_t q = p + 1; q < 3; ++q) row.push_back(text(fit.covariance[p][q]));
  }
  row.push_back(text(fit.chi_squared));
  row.push_back(text(fit.degrees_of_freedom));
  row.push_back(text(fit.chi_squared / fit.degrees_of_freedom));
  row.push_back(text(fit.log_likelihood));
  row.push_back(text(fit.law.integral()));
  row.push_back(text(fit.law.mean()));
  row.push_back(text(fit.law.shift_of(2.46)));
  row.push_back(text(fit.b_at_bound));
  row.push_back("");
  return row;
}

CsvTable fits_table(const Analysis& analysis) {
  CsvTable table({{"set", ""},
                  {"form", ""},
                  {"method", ""},
                  {"a", "1/mean force"},
                  {"a_se", "1/mean force"},
                  {"b", "1"},
                  {"b_se", "1"},
                  {"beta", "1/mean force"},
                  {"beta_se", "1/mean force"},
                  {"theta", "mean force"},
                  {"theta_se", "mean force"},
                  {"covariance_a_b", ""},
                  {"covariance_a_beta", ""},
                  {"covariance_b_beta", ""},
                  {"chi_squared", "1"},
                  {"degrees_of_freedom", "1"},
                  {"chi_squared_per_degree", "1"},
                  {"log_likelihood", "1"},
                  {"integral", "1"},
                  {"mean", "mean force"},
                  {"lambda_for_a_2.46", "mean force"},
                  {"b_at_bound", "1"},
                  {"reason", ""}});
  each_set(analysis, [&](const std::string& set, const ForceDistribution& of) {
    table.add_row(fit_row(set, "plain", "histogram", of.by_histogram));
    table.add_row(fit_row(set, "plain", "likelihood", of.by_likelihood));
    table.add_row(fit_row(set, "shifted", "histogram", of.shifted_by_histogram));
    table.add_row(fit_row(set, "shifted", "likelihood", of.shifted_by_likelihood));
  });
  for (const auto& [source, fit] : analysis.published) {
    table.add_row(fit_row("all", "plain", source, fit));
  }
  return table;
}

CsvTable correlation_table(const Analysis& analysis) {
  CsvTable table(
      {{"set", ""}, {"r", "d"}, {"pairs", "1"}, {"F", "1"}, {"F_uncorrelated_scatter", "1"}});
  for (std::size_t set = 0; set < analysis.correlation.size(); ++set) {
    const auto& of = analysis.correlation[set];
    const std::string name =
        set + 1 == analysis.correlation.size() ? "all" : "pass " + text(set + 1);
    for (std::size_t bin = 0; bin < of.F.size(); ++bin) {
      table.add_row({name, text(of.r(bin)), text(of.pairs[bin]), text(of.F[bin]),
                     text(of.uncorrelated_scatter[bin])});
    }
  }
  return table;
}

CsvTable missing_table(const Snapshot& snapshot, const Analysis& analysis) {
  CsvTable table({{"i", ""},
                  {"j", ""},
                  {"length", "length"},
                  {"detour", "length"},
                  {"normal_force", "force"},
                  {"large_grain", "1"}});
  for (const MissingContact& missing : analysis.contacting.missing) {
    const Contact& contact = snapshot.contacts[missing.contact];
    table.add_row({std::to_string(snapshot.id[contact.i]), std::to_string(snapshot.id[contact.j]),
                   text(missing.length), text(missing.detour), text(contact.normal_force),
                   text(missing.large_grain)});
  }
  return table;
}

}  // namespace

std::vector<std::string> provenance(const Snapshot& snapshot, const Analysis& analysis) {
  return {"snapshot: " + snapshot.name,
          "grains: " + text(snapshot.grains()),
          "wall contacts, in no network: " + text(snapshot.wall_contacts),
          "spanning trees: " + text(analysis.options.passes) + " passes, elongation " +
              text(analysis.options.elongation),
          "d (median grain diameter): " + text(analysis.median_diameter),
          "f is the normal force over the mean " + text(analysis.networks.mean_force) +
              " of all contacts; in the set `largest` over the mean " +
              text(analysis.largest.mean_force) + " of that network"};
}

std::vector<NamedTable> tables(const Snapshot& snapshot, const Analysis& analysis) {
  std::vector<NamedTable> all{{"networks", networks_table(analysis)},
                              {"contacts", contacts_table(snapshot, analysis)},
                              {"passes", passes_table(analysis)},
                              {"force_pdf", pdf_table(analysis)},
                              {"force_fits", fits_table(analysis)},
                              {"correlation", correlation_table(analysis)},
                              {"missing", missing_table(snapshot, analysis)}};
  for (auto& one : all) one.table.provenance = provenance(snapshot, analysis);
  return all;
}

}  // namespace shakebed::fitting::networks
