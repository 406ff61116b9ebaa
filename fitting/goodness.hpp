#pragma once

#include <cstddef>
#include <vector>

#include "fitting/least_squares.hpp"

namespace shakebed::fitting {

/// Wald-Wolfowitz test of the residuals' signs in order of x. Too few runs mean that the curve
/// misses the data systematically. Its p-value is exact for signs in random order; the residuals
/// of a fit with p parameters are slightly anti-correlated, which makes it a little conservative.
struct RunsTest {
  std::size_t positive = 0;
  std::size_t negative = 0;
  std::size_t runs = 0;
  double expected_runs = 0;
  double p_value = 1;  ///< probability of this many runs or fewer
};
RunsTest runs_test(const std::vector<double>& residuals);

/// Pearson's correlation of the measured and the fitted values, without weights: what plotting
/// programs print as R, and for a curve with a free constant and equal weights sqrt(1 - SS_res /
/// SS_tot). The paper does not say which it prints; these two agree for Table III.
double correlation_coefficient(const std::vector<double>& measured,
                               const std::vector<double>& fitted);

/// Akaike's information criterion. Estimated scale: n ln(chi^2/n) + 2 (p + 1); given scale:
/// chi^2 + 2 p. Constants of the weights are left out: compare only fits of the same points, the
/// same column and the same weights.
struct InformationCriterion {
  double aic;
  double aicc;  ///< with the correction for few points, 2 k (k+1)/(n - k - 1)
};
InformationCriterion information_criterion(double chi_squared, std::size_t points,
                                           std::size_t parameters, Scale scale);

}  // namespace shakebed::fitting
