#include "simulator/observables/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace shakebed::simulator {
namespace {

double autocovariance(std::span<const double> series, double mean, std::size_t lag) {
  double sum = 0;
  for (std::size_t k = lag; k < series.size(); ++k) {
    sum += (series[k] - mean) * (series[k - lag] - mean);
  }
  return sum / static_cast<double>(series.size() - lag);
}

}  // namespace

CorrelatedMean mean_of_series(std::span<const double> series) {
  CorrelatedMean result{};
  const auto n = static_cast<double>(series.size());
  if (series.empty()) return result;
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  result.estimate.mean = mean;
  result.correlation_time = 0.5;
  result.independent = n;
  if (series.size() < 4) return result;

  const double variance = autocovariance(series, mean, 0);
  if (variance <= 0) {
    result.estimate.standard_error = 0;
    return result;
  }
  constexpr double window_factor = 1.5;
  constexpr double uncorrelated = 0.5;
  double covariance_sum = variance;
  double tau = uncorrelated;
  std::size_t window = 0;
  for (std::size_t lag = 1; lag < series.size() / 2; ++lag) {
    covariance_sum += 2 * autocovariance(series, mean, lag);
    tau = std::max(0.5 * covariance_sum / variance, uncorrelated);
    window = lag;
    const double decay =
        tau == uncorrelated ? 1e-8 : window_factor / std::log((2 * tau + 1) / (2 * tau - 1));
    const auto w = static_cast<double>(lag);
    if (std::exp(-w / decay) - decay / std::sqrt(w * n) < 0) break;
  }
  // Subtracting the sample mean lowers every covariance by about the variance of the mean.
  tau *= 1 + (2 * static_cast<double>(window) + 1) / n;
  result.correlation_time = tau;
  result.independent = n / (2 * tau);
  result.estimate.standard_error = std::sqrt(2 * tau * variance / n);
  return result;
}

CorrelatedMean cautious_mean_of_series(std::span<const double> series) {
  constexpr std::size_t least_entries = 30;
  const CorrelatedMean plain = mean_of_series(series);
  double error = plain.estimate.standard_error;
  std::vector<double> coarser(series.begin(), series.end());
  while (coarser.size() / 2 >= least_entries) {
    const std::size_t pairs = coarser.size() / 2;
    for (std::size_t k = 0; k < pairs; ++k)
      coarser[k] = 0.5 * (coarser[2 * k] + coarser[2 * k + 1]);
    coarser.resize(pairs);
    error = std::max(error, mean_of_series(coarser).estimate.standard_error);
  }
  if (!(error > plain.estimate.standard_error)) return plain;
  const double longer = std::pow(error / plain.estimate.standard_error, 2);
  return {
      {plain.estimate.mean, error}, plain.correlation_time * longer, plain.independent / longer};
}

bool halves_agree(std::span<const double> series, MeanOfSeries mean_of) {
  const auto first = mean_of(series.first(series.size() / 2)).estimate;
  const auto second = mean_of(series.last(series.size() / 2)).estimate;
  constexpr double quantile = 3.89;  // of drift_false_alarm
  return std::abs(first.mean - second.mean) <= quantile * std::sqrt(2.0) * second.standard_error;
}

}  // namespace shakebed::simulator
