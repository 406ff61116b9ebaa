#include <algorithm>
#include <cmath>
#include <limits>

#include "fitting/networks/ensemble.hpp"

namespace shakebed::fitting::networks {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

class Numbers {
 public:
  void add(const std::string& name, const std::string& unit, double value) {
    all.push_back({name, unit, value});
  }
  void count(const std::string& name, std::size_t value) {
    add(name, "1", static_cast<double>(value));
  }
  std::vector<NamedNumber> all;
};

void add_networks(Numbers& numbers, const ForceNetworks& found) {
  numbers.count("networks", found.networks.size());
  numbers.count("contacts", found.contacts.size());
  numbers.count("pulling", found.pulling);
  numbers.add("mean_force", "m g", found.contacts.empty() ? none : found.mean_force);
  const ForceNetwork nothing;
  const bool any = !found.networks.empty();
  const ForceNetwork& largest = any ? found.networks.front() : nothing;
  numbers.count("largest_grains", largest.grains.size());
  numbers.count("largest_contacts", largest.contacts.size());
  numbers.add("largest_coordination", "1", any ? largest.coordination : 0);
  numbers.count("largest_strong_contacts", largest.strong_contacts);
  numbers.count("largest_strong_grains", largest.strong_grains);
  numbers.count("largest_grains_with_strong_contact", largest.grains_with_strong_contact);
  numbers.add("largest_extent", "d", any ? largest.extent : 0);
  numbers.add("largest_mean_force", "m g", any ? largest.mean_force : none);
}

void add_passes(Numbers& numbers, const ContactingTrees& found) {
  const auto add = [&](const PassCounts& row, const std::string& name) {
    numbers.count("NP_" + name, row.NP);
    numbers.count("NE_" + name, row.NE);
    numbers.count("NT_" + name, row.NT);
    numbers.count("NE_rest_" + name, row.NE_rest);
    numbers.count("missing_" + name, row.missing);
  };
  for (const auto& row : found.passes) add(row, std::to_string(row.passes));
  add(found.network, "network");
  std::size_t large = 0;
  for (const auto& missing : found.missing) large += missing.large_grain ? 1 : 0;
  numbers.count("missing_of_large_grain", large);
  numbers.count("missing_of_small_grains", found.missing.size() - large);
  // Differences and shares bed by bed: over replicas they are known better than their parts.
  const auto of = [](std::size_t count) { return static_cast<double>(count); };
  const PassCounts& all = found.network;
  const PassCounts& one = found.passes.front();
  numbers.add("grains_left_out", "1", of(all.NP) - of(one.NP));
  numbers.add("trees_left_out", "1", of(all.NT) - of(one.NT));
  for (const auto& row : found.passes) {
    numbers.add("NE_share_" + std::to_string(row.passes), "1",
                all.NE > 0 ? of(row.NE) / of(all.NE) : none);
  }
}

void add_fit(Numbers& numbers, const ForceFit& fit, const std::string& method) {
  const bool good = fit.good();
  numbers.add("a_" + method, "1/mean force", good ? fit.law.a : none);
  numbers.add("b_" + method, "1", good ? fit.law.b : none);
  numbers.add("beta_" + method, "1/mean force", good ? fit.law.beta : none);
}

/// Share of forces f >= 0 below a multiple of the mean; bins are cut in proportion.
double share_below(const ForceDistribution& of, double f) {
  const ForceHistogram& histogram = of.histogram;
  if (histogram.total == 0) return none;
  double below = 0;
  for (std::size_t bin = 0; bin < histogram.bins(); ++bin) {
    const double part = (f - histogram.edges[bin]) / histogram.width(bin);
    below += std::clamp(part, 0.0, 1.0) * static_cast<double>(histogram.counts[bin]);
  }
  return below / static_cast<double>(histogram.total);
}

double theta_of(const ForceDistribution& of) {
  const ForceFit& fit = of.shifted_by_likelihood;
  return fit.good() ? fit.law.theta : none;
}

/// Mean of F over 0.5 to 3 d.
double near_correlation(const ForceCorrelation& of) {
  double sum = 0, bins = 0;
  for (std::size_t k = 0; k < of.F.size(); ++k) {
    if (of.r(k) < 0.5 || of.r(k) > 3 || std::isnan(of.F[k])) continue;
    sum += of.F[k];
    ++bins;
  }
  return bins > 0 ? sum / bins : none;
}

/// What passes 1 .. p capture against all contacts, bed by bed: both hold mostly the same forces,
/// so that over replicas ratio and difference are known far better than their parts.
void add_passes_against_all(Numbers& numbers, const Analysis& analysis) {
  const ForceFit& plain = analysis.all.by_likelihood;
  for (std::size_t p = 0; p < analysis.by_pass.size(); ++p) {
    const auto& pass = analysis.by_pass[p];
    const auto number = std::to_string(p + 1);
    const ForceFit& shifted = pass.shifted_by_likelihood;
    numbers.add("theta_" + number, "mean force", theta_of(pass));
    numbers.add("theta_less_all_" + number, "mean force", theta_of(pass) - theta_of(analysis.all));
    numbers.add("beta_over_all_" + number, "1",
                shifted.good() && plain.good() ? shifted.law.beta / plain.law.beta : none);
    numbers.add("weak_over_all_" + number, "1",
                share_below(pass, 0.5) / share_below(analysis.all, 0.5));
    numbers.add("below_mean_over_all_" + number, "1",
                share_below(pass, 1) / share_below(analysis.all, 1));
    numbers.add(
        "F_near_over_all_" + number, "1",
        near_correlation(analysis.correlation[p]) / near_correlation(analysis.correlation.back()));
  }
}

void add_correlation(Numbers& numbers, const ForceCorrelation& found) {
  double plateau = 0, bins = 0, peak = 0, at = none, at_three = none;
  for (std::size_t k = 0; k < found.F.size(); ++k) {
    if (std::isnan(found.F[k])) continue;
    const double r = found.r(k);
    if (r > 4 && r < 6) {
      plateau += found.F[k];
      ++bins;
    }
    if (r > 0.5 && r < 1.5 && found.F[k] > peak) {
      peak = found.F[k];
      at = r;
    }
    if (std::abs(r - 3) <= found.bin_width) at_three = found.F[k];
  }
  plateau = bins > 0 ? plateau / bins : none;
  numbers.add("F_plateau", "1", plateau);
  numbers.add("F_peak_at", "d", at);
  numbers.add("F_peak_over_plateau", "1", peak / plateau);
  numbers.add("F_at_3_over_plateau", "1", at_three / plateau);
}

}  // namespace

std::vector<NamedNumber> numbers_of(const Analysis& analysis) {
  Numbers numbers;
  add_networks(numbers, analysis.networks);
  add_passes(numbers, analysis.contacting);
  add_fit(numbers, analysis.all.by_histogram, "histogram");
  add_fit(numbers, analysis.all.by_likelihood, "likelihood");
  add_passes_against_all(numbers, analysis);
  add_correlation(numbers, analysis.correlation.back());
  return numbers.all;
}

}  // namespace shakebed::fitting::networks
