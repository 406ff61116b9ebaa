#include "fitting/goodness.hpp"

#include <gsl/gsl_sf_gamma.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace shakebed::fitting {
namespace {

double choose(std::size_t n, std::size_t k) {
  if (k > n) return 0;
  return std::exp(gsl_sf_lnchoose(static_cast<unsigned>(n), static_cast<unsigned>(k)));
}

/// Number of sign sequences with exactly `runs` runs, over all C(n_+ + n_-, n_+).
double probability_of(std::size_t runs, std::size_t positive, std::size_t negative) {
  const std::size_t half = runs / 2;
  const double ways = runs % 2 == 0
                          ? 2 * choose(positive - 1, half - 1) * choose(negative - 1, half - 1)
                          : choose(positive - 1, half) * choose(negative - 1, half - 1) +
                                choose(positive - 1, half - 1) * choose(negative - 1, half);
  return ways / choose(positive + negative, positive);
}

}  // namespace

RunsTest runs_test(const std::vector<double>& residuals) {
  RunsTest test;
  bool last = false;
  for (double residual : residuals) {
    if (residual == 0) continue;
    const bool sign = residual > 0;
    if (test.runs == 0 || sign != last) ++test.runs;
    last = sign;
    ++(sign ? test.positive : test.negative);
  }
  const double n = double(test.positive + test.negative);
  if (test.positive == 0 || test.negative == 0) {
    test.expected_runs = n > 0 ? 1 : 0;
    return test;
  }
  test.expected_runs = 1 + 2 * double(test.positive) * double(test.negative) / n;
  test.p_value = 0;
  for (std::size_t runs = 2; runs <= test.runs; ++runs) {
    test.p_value += probability_of(runs, test.positive, test.negative);
  }
  test.p_value = std::min(test.p_value, 1.0);
  return test;
}

double correlation_coefficient(const std::vector<double>& measured,
                               const std::vector<double>& fitted) {
  return gsl_stats_correlation(measured.data(), 1, fitted.data(), 1, measured.size());
}

InformationCriterion information_criterion(double chi_squared, std::size_t points,
                                           std::size_t parameters, Scale scale) {
  const double n = double(points);
  const double k = double(parameters) + (scale == Scale::estimated ? 1 : 0);
  const double deviance = scale == Scale::estimated ? n * std::log(chi_squared / n) : chi_squared;
  const double aic = deviance + 2 * k;
  const double aicc = n - k - 1 > 0 ? aic + 2 * k * (k + 1) / (n - k - 1)
                                    : std::numeric_limits<double>::quiet_NaN();
  return {aic, aicc};
}

}  // namespace shakebed::fitting
