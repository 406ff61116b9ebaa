#include "fitting/networks/force_fit.hpp"

#include <cmath>

#include "fitting/networks/force_fit_parts.hpp"

namespace shakebed::fitting::networks {

double ForceFit::standard_error(std::size_t parameter) const {
  return std::sqrt(covariance[parameter][parameter]);
}

std::string reason_not_to_fit(const ForceHistogram& histogram, Form form) {
  const std::size_t least_bins = form == Form::plain ? 6 : 7;
  if (histogram.bins() >= least_bins) return {};
  return "the " + std::to_string(histogram.total) + " forces f >= 0 fill " +
         std::to_string(histogram.bins()) + " bins of at least " + std::to_string(least_count) +
         ", and a fit needs " + std::to_string(least_bins);
}

double bin_fraction(const ForceLaw& law, const ForceHistogram& histogram, std::size_t bin) {
  const bool last = bin + 1 == histogram.bins();
  return law.integral(histogram.edges[bin], last ? infinity : histogram.edges[bin + 1]);
}

double chi_squared(const ForceLaw& law, const ForceHistogram& histogram) {
  const auto total = static_cast<double>(histogram.total);
  double sum = 0;
  for (std::size_t bin = 0; bin < histogram.bins(); ++bin) {
    const double expected = total * bin_fraction(law, histogram, bin);
    const double difference = static_cast<double>(histogram.counts[bin]) - expected;
    sum += difference * difference / expected;
  }
  return sum;
}

double log_likelihood(const ForceLaw& law, std::span<const double> f) {
  const double log_norm = std::log(law.integral());
  double sum = 0;
  for (const double one : f) {
    if (one >= 0) sum += std::log(law.density(one)) - log_norm;
  }
  return sum;
}

ForceFit compare(const ForceLaw& law, std::span<const double> f, const ForceHistogram& histogram) {
  ForceFit fit;
  fit.law = law;
  fit.chi_squared = chi_squared(law, histogram);
  fit.degrees_of_freedom = static_cast<int>(histogram.bins());
  fit.log_likelihood = log_likelihood(law, f);
  return fit;
}

}  // namespace shakebed::fitting::networks
