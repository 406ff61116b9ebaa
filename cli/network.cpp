#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/network_json.hpp"
#include "files/atomic_file.hpp"
#include "files/csv.hpp"
#include "fitting/networks/tables.hpp"

namespace shakebed::cli {

namespace {

namespace networks = fitting::networks;

networks::Snapshot read(const NetworkOptions& options) {
  if (options.snapshot) return networks::read_snapshot_hdf5(*options.snapshot);
  return networks::read_snapshot_csv(options.grains.value(), options.contacts.value());
}

std::vector<std::string> warnings(const networks::Snapshot& snapshot,
                                  const networks::Analysis& analysis) {
  std::vector<std::string> all;
  const auto tell = [&](std::size_t count, const std::string& what) {
    if (count > 0)
      all.push_back(std::to_string(count) + " of " + std::to_string(snapshot.contacts.size()) +
                    " contacts " + what);
  };
  tell(snapshot.contacts_not_touching,
       "join grains that do not overlap, by more than coordinates of 6 digits explain");
  tell(analysis.networks.without_force, "carry no force and belong to no network");
  if (analysis.networks.networks.empty()) {
    all.push_back("no contact between grains carries a force: there is no network");
  }
  return all;
}

void print_fit(const char* method, const networks::ForceFit& fit) {
  if (!fit.good()) {
    std::printf("  %-24s none: %s\n", method, fit.failure.c_str());
    return;
  }
  std::printf("  %-24s a = %.3f(%.3f)  b = %.3f(%.3f)  beta = %.3f(%.3f)", method, fit.law.a,
              fit.standard_error(0), fit.law.b, fit.standard_error(1), fit.law.beta,
              fit.standard_error(2));
  if (fit.covariance[3][3] > 0) {
    std::printf("  theta = %.3f(%.3f)", fit.law.theta, fit.standard_error(3));
  }
  std::printf("  chi^2/dof = %.1f/%d  ln L = %.1f  integral %.3f, mean %.3f%s\n", fit.chi_squared,
              fit.degrees_of_freedom, fit.log_likelihood, fit.law.integral(), fit.law.mean(),
              fit.b_at_bound ? "  (b held at its bound 1)" : "");
}

void print_networks(const networks::Snapshot& snapshot, const networks::Analysis& analysis) {
  const auto& all = analysis.networks;
  std::printf("%zu grains, %zu contacts with force (%zu of them pull), %zu with walls\n",
              snapshot.grains(), all.contacts.size(), all.pulling, snapshot.wall_contacts);
  std::printf("%zu force networks, mean force %.6g\n", all.networks.size(), all.mean_force);
  if (all.networks.empty()) return;
  const auto& largest = all.networks.front();
  std::printf(
      "largest: %zu grains, %zu contacts, coordination %.3f, extent %.4g, mean force %.6g\n",
      largest.grains.size(), largest.contacts.size(), largest.coordination, largest.extent,
      largest.mean_force);
  std::printf("  strong: %zu contacts; %zu grains in their largest component, %zu grains in all\n",
              largest.strong_contacts, largest.strong_grains, largest.grains_with_strong_contact);
}

void print_distribution(const networks::Analysis& analysis) {
  std::printf("P(f) = a (1 - b exp(-f^2)) exp(-beta f) of %zu forces\n", analysis.all.forces);
  print_fit("histogram", analysis.all.by_histogram);
  print_fit("likelihood", analysis.all.by_likelihood);
  print_fit("shifted, histogram", analysis.all.shifted_by_histogram);
  print_fit("shifted, likelihood", analysis.all.shifted_by_likelihood);
  for (const auto& [source, fit] : analysis.published) {
    std::printf(
        "  %-24s a = %.2f  b = %.2f  beta = %.2f  chi^2/dof = %.1f/%d  ln L = %.1f"
        "  integral %.3f, mean %.3f\n",
        source.c_str(), fit.law.a, fit.law.b, fit.law.beta, fit.chi_squared, fit.degrees_of_freedom,
        fit.log_likelihood, fit.law.integral(), fit.law.mean());
  }
}

void print_passes(const networks::Analysis& analysis) {
  std::printf("spanning trees, elongation %g\n%8s %8s %8s %8s %8s %8s\n",
              analysis.options.elongation, "passes", "NP", "NE", "NT", "NE_rest", "missing");
  for (const auto& row : analysis.contacting.passes) {
    std::printf("%8d %8zu %8zu %8zu %8zu %8zu\n", row.passes, row.NP, row.NE, row.NT, row.NE_rest,
                row.missing);
  }
  const auto& network = analysis.contacting.network;
  std::printf("%8s %8zu %8zu %8zu %8zu\n", "networks", network.NP, network.NE, network.NT,
              network.NE_rest);
  std::size_t large = 0;
  for (const auto& missing : analysis.contacting.missing) large += missing.large_grain ? 1 : 0;
  if (!analysis.contacting.missing.empty()) {
    std::printf("missing after the last pass: %zu, of them %zu of a large grain\n",
                analysis.contacting.missing.size(), large);
  }
}

}  // namespace

int network_command(const NetworkOptions& options) {
  const auto snapshot = read(options);
  networks::AnalysisOptions wanted;
  wanted.passes = options.passes;
  wanted.elongation = options.elongation;
  wanted.force_bin = options.force_bin;
  wanted.correlation_bin = options.correlation_bin;
  wanted.correlation_reach = options.correlation_reach;
  const auto analysis = networks::analyse(snapshot, wanted);
  const auto told = warnings(snapshot, analysis);

  if (options.csv_folder) {
    for (const auto& [stem, table] : networks::tables(snapshot, analysis)) {
      table.write(*options.csv_folder / (stem + ".csv"));
    }
  }
  const bool json_on_stdout = options.json && *options.json == "-";
  if (options.json) {
    const auto text = network_json(snapshot, analysis, told).dump(2) + "\n";
    if (json_on_stdout) {
      std::fputs(text.c_str(), stdout);
    } else {
      files::write_text(*options.json, text);
    }
  }
  if (!json_on_stdout) {
    print_networks(snapshot, analysis);
    print_distribution(analysis);
    print_passes(analysis);
  }
  for (const auto& warning : told) std::fprintf(stderr, "shakebed: warning: %s\n", warning.c_str());
  return 0;
}

}  // namespace shakebed::cli
