#include <cmath>
#include <optional>

#include "fitting/networks/ensemble.hpp"

namespace shakebed::fitting::networks {
namespace {

using files::CsvTable;
using files::number_text;
using Labels = Ensemble::Labels;

constexpr double largest_f = 10;  ///< of the histograms; the tail beyond is in the fits alone

/// The sets of contacts of an analysis: 0 is all of them, p those of passes 1 .. p.
std::string name_of_set(std::size_t set) {
  return set == 0 ? "all" : "pass " + std::to_string(set);
}
const ForceDistribution& set_of(const Analysis& analysis, std::size_t set) {
  return set == 0 ? analysis.all : analysis.by_pass[set - 1];
}

/// P(f) of one bed in equal bins, over f >= 0.
std::vector<double> densities(const Member& member, std::size_t set) {
  const auto& analysis = member.analysis;
  const double bin = analysis.options.force_bin;
  std::vector<double> density(static_cast<std::size_t>(std::lround(largest_f / bin)), 0.0);
  double total = 0;
  for (const Index k : analysis.networks.contacts) {
    const int first = analysis.contacting.first_pass[k];
    if (set > 0 && (first == 0 || first > static_cast<int>(set))) continue;
    const double f = member.snapshot.contacts[k].normal_force / analysis.networks.mean_force;
    if (f < 0) continue;
    ++total;
    const auto place = static_cast<std::size_t>(f / bin);
    if (place < density.size()) ++density[place];
  }
  for (double& one : density) one /= total * bin;
  return density;
}

const ForceFit& fit_of(const ForceDistribution& of, std::size_t kind) {
  switch (kind) {
    case 0:
      return of.by_histogram;
    case 1:
      return of.by_likelihood;
    case 2:
      return of.shifted_by_histogram;
    default:
      return of.shifted_by_likelihood;
  }
}

/// What a fit puts into a bin, on average over the replicas that have the fit.
std::string fitted(const std::vector<Member>& members, std::size_t set, std::size_t kind,
                   double from, double to) {
  std::vector<double> values;
  for (const auto& member : members) {
    const ForceFit& fit = fit_of(set_of(member.analysis, set), kind);
    if (fit.good()) values.push_back(fit.law.integral(from, to) / (to - from));
  }
  return values.empty() ? "" : number_text(spread(values).mean);
}

std::string printed(const std::optional<ForceLaw>& law, double from, double to) {
  return law ? number_text(law->integral(from, to) / (to - from)) : "";
}

struct Text {
  std::string mean, sd, se;
};
Text text_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const Spread found = spread(values);
  return {number_text(found.mean), number_text(found.standard_deviation),
          number_text(found.standard_deviation / std::sqrt(static_cast<double>(values.size())))};
}

}  // namespace

std::vector<files::CsvColumn> pdf_columns() {
  return {{"set", ""},
          {"f_from", "mean force"},
          {"f_to", "mean force"},
          {"f", "mean force"},
          {"P", "1/mean force"},
          {"P_sd", "1/mean force"},
          {"P_se", "1/mean force"},
          {"P_histogram_fit", "1/mean force"},
          {"P_likelihood_fit", "1/mean force"},
          {"P_shifted_histogram_fit", "1/mean force"},
          {"P_shifted_likelihood_fit", "1/mean force"},
          {"P_paper", "1/mean force"},
          {"P_paper_other", "1/mean force"}};
}

void add_pdf_rows(CsvTable& table, const Labels& place, const std::vector<Member>& members) {
  const std::size_t sets = members.front().analysis.by_pass.size() + 1;
  const double bin = members.front().analysis.options.force_bin;
  for (std::size_t set = 0; set < sets; ++set) {
    std::vector<std::vector<double>> density;
    for (const auto& member : members) {
      if (member.analysis.networks.mean_force > 0) density.push_back(densities(member, set));
    }
    if (density.empty()) continue;
    const auto paper = published_law_of_pass(static_cast<int>(set));
    for (std::size_t k = 0; k < density.front().size(); ++k) {
      const double from = static_cast<double>(k) * bin;
      const double to = static_cast<double>(k + 1) * bin;
      std::vector<double> here;
      for (const auto& one : density) here.push_back(one[k]);
      const Text P = text_of(here);
      auto cells = place;
      cells.insert(cells.end(), {name_of_set(set), number_text(from), number_text(to),
                                 number_text(0.5 * (from + to)), P.mean, P.sd, P.se});
      for (std::size_t kind = 0; kind < 4; ++kind) {
        cells.push_back(fitted(members, set, kind, from, to));
      }
      cells.push_back(printed(paper.whole, from, to));
      cells.push_back(printed(paper.other, from, to));
      table.add_row(std::move(cells));
    }
  }
}

std::vector<files::CsvColumn> fit_columns() {
  std::vector<files::CsvColumn> columns{{"set", ""}, {"form", ""}, {"method", ""}};
  for (const char* name : {"a", "b", "beta", "theta", "integral", "mean", "chi_squared_per_degree",
                           "lambda_for_printed_a"}) {
    for (const char* ending : {"", "_sd", "_se"})
      columns.push_back({std::string(name) + ending, ""});
  }
  columns.push_back({"replicas", "1"});
  columns.push_back({"replicas_with_b_at_bound", "1"});
  return columns;
}

void add_fit_rows(CsvTable& table, const Labels& place, const std::vector<Member>& members) {
  const std::size_t sets = members.front().analysis.by_pass.size() + 1;
  for (std::size_t set = 0; set < sets; ++set) {
    for (std::size_t kind = 0; kind < 4; ++kind) {
      std::array<std::vector<double>, 8> values;
      int at_bound = 0;
      for (const auto& member : members) {
        const ForceFit& fit = fit_of(set_of(member.analysis, set), kind);
        if (!fit.good()) continue;
        const ForceLaw& law = fit.law;
        const double all[] = {law.a,
                              law.b,
                              law.beta,
                              law.theta,
                              law.integral(),
                              law.mean(),
                              fit.chi_squared / fit.degrees_of_freedom,
                              law.shift_of(2.46)};
        for (std::size_t p = 0; p < values.size(); ++p) values[p].push_back(all[p]);
        at_bound += fit.b_at_bound;
      }
      auto cells = place;
      cells.insert(cells.end(), {name_of_set(set), kind < 2 ? "plain" : "shifted",
                                 kind % 2 == 0 ? "histogram" : "likelihood"});
      for (const auto& one : values) {
        const Text text = text_of(one);
        cells.insert(cells.end(), {text.mean, text.sd, text.se});
      }
      cells.push_back(std::to_string(values[0].size()));
      cells.push_back(std::to_string(at_bound));
      table.add_row(std::move(cells));
    }
  }
}

std::vector<files::CsvColumn> correlation_columns() {
  return {{"set", ""}, {"r", "d"}, {"pairs", "1"}, {"F", "1"}, {"F_se", "1"}};
}

void add_correlation_rows(CsvTable& table, const Labels& place,
                          const std::vector<Member>& members) {
  const std::size_t sets = members.front().analysis.correlation.size();
  for (std::size_t set = 0; set < sets; ++set) {
    std::vector<ForceCorrelation> replicas;
    for (const auto& member : members) replicas.push_back(member.analysis.correlation[set]);
    const ForceCorrelation mean = mean_over_replicas(replicas);
    for (std::size_t bin = 0; bin < mean.F.size(); ++bin) {
      auto cells = place;
      cells.insert(cells.end(), {set + 1 == sets ? "all" : name_of_set(set + 1),
                                 number_text(mean.r(bin)), std::to_string(mean.pairs[bin]),
                                 number_text(mean.F[bin]), number_text(mean.standard_error[bin])});
      table.add_row(std::move(cells));
    }
  }
}

}  // namespace shakebed::fitting::networks
