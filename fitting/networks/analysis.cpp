#include "fitting/networks/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace shakebed::fitting::networks {

namespace {

ForceDistribution distribution(const Snapshot& snapshot, std::span<const Index> contacts,
                               double mean_force, Scale scale, double bin_width) {
  ForceDistribution found;
  found.mean_force = mean_force;
  std::vector<double> f;
  for (const Index k : contacts) {
    const double force = snapshot.contacts[k].normal_force;
    if (force < 0) ++found.pulling;
    // Without a positive mean there is no scale, and no distribution of f.
    if (mean_force > 0) f.push_back(force / mean_force);
  }
  found.forces = contacts.size() - found.pulling;
  found.histogram = force_histogram(f, bin_width);
  found.by_histogram = fit_histogram(f, found.histogram, Form::plain, scale);
  found.by_likelihood = fit_likelihood(f, found.histogram, found.by_histogram, Form::plain, scale);
  found.shifted_by_histogram = fit_histogram(f, found.histogram, Form::shifted, scale);
  found.shifted_by_likelihood =
      fit_likelihood(f, found.histogram, found.shifted_by_histogram, Form::shifted, scale);
  return found;
}

std::vector<Comparison> comparisons(const Snapshot& snapshot, const Analysis& analysis) {
  std::vector<Comparison> found;
  if (analysis.all.histogram.total == 0) return found;
  std::vector<double> f;
  for (const Index k : analysis.networks.contacts) {
    f.push_back(snapshot.contacts[k].normal_force / analysis.networks.mean_force);
  }
  for (const auto& [source, law] : published_laws()) {
    found.push_back({source, compare(law, f, analysis.all.histogram)});
  }
  return found;
}

std::vector<Index> captured(const Analysis& analysis, int passes) {
  std::vector<Index> contacts;
  for (const Index k : analysis.networks.contacts) {
    const int first = analysis.contacting.first_pass[k];
    if (first > 0 && first <= passes) contacts.push_back(k);
  }
  return contacts;
}

std::vector<ForceCorrelation> correlations(const Snapshot& snapshot, const Analysis& analysis) {
  std::vector<PlacedForce> placed;
  const double d = analysis.median_diameter, mean = analysis.networks.mean_force;
  const int passes = analysis.options.passes;
  for (const Index k : analysis.networks.contacts) {
    const Contact& contact = snapshot.contacts[k];
    const Point &a = snapshot.position[contact.i], &b = snapshot.position[contact.j];
    PlacedForce one{{}, mean != 0 ? contact.normal_force / mean : 0, passes};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      one.midpoint[axis] = (a[axis] / 2 + b[axis] / 2) / d;
    }
    if (const int first = analysis.contacting.first_pass[k]; first > 0) one.first_set = first - 1;
    placed.push_back(one);
  }
  return force_correlations(placed, passes + 1, analysis.options.correlation_bin,
                            analysis.options.correlation_reach);
}

}  // namespace

Analysis analyse(const Snapshot& snapshot, const AnalysisOptions& options) {
  Analysis found;
  found.options = options;
  found.median_diameter = median_diameter(snapshot);
  found.networks = force_networks(snapshot);
  found.trees = spanning_trees(snapshot.position, options.passes, options.elongation);
  found.contacting = contacting_trees(snapshot, found.networks, found.trees, options.elongation);

  found.all = distribution(snapshot, found.networks.contacts, found.networks.mean_force,
                           Scale::sample_mean, options.force_bin);
  if (!found.networks.networks.empty()) {
    const ForceNetwork& largest = found.networks.networks.front();
    found.largest = distribution(snapshot, largest.contacts, largest.mean_force, Scale::sample_mean,
                                 options.force_bin);
  } else {
    found.largest = found.all;
  }
  found.published = comparisons(snapshot, found);
  for (int passes = 1; passes <= options.passes; ++passes) {
    found.by_pass.push_back(distribution(snapshot, captured(found, passes),
                                         found.networks.mean_force, Scale::given,
                                         options.force_bin));
  }
  found.correlation = correlations(snapshot, found);
  return found;
}

Spread spread(const std::vector<double>& values) {
  Spread found;
  found.replicas = values.size();
  const auto n = static_cast<double>(values.size());
  for (const double value : values) found.mean += value / n;
  double squares = 0;
  for (const double value : values) squares += (value - found.mean) * (value - found.mean);
  found.standard_deviation =
      values.size() > 1 ? std::sqrt(squares / (n - 1)) : std::numeric_limits<double>::quiet_NaN();
  return found;
}

}  // namespace shakebed::fitting::networks
