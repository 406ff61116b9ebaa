#pragma once

#include <string>
#include <vector>

#include "fitting/fit.hpp"

namespace shakebed::fitting {

/// Smallest and largest estimate.
struct Spread {
  double low;
  double high;
};

/// The exponent of one power law under its default rule, and how far it moves with the kind of
/// fit, with the ends of the range, and with both: a range that is not printed or a method that is
/// not named is an uncertainty of its own, often larger than the statistical one.
struct Exponent {
  const FitResult* by_default;
  Spread over_methods;  ///< every method and weighting, range as written
  Spread over_ranges;   ///< default method and weighting, every stretched range
  Spread over_all;
  std::size_t variants;  ///< fitted ones, the default included
  Spread W;              ///< of the points of the default fit: how much of the range was measured
  /// What the points' own errors sigma_i make of alpha, the rule and the points held:
  /// sqrt(sum_i (d alpha/d y_i sigma_i)^2). NaN when a point has no error. The fit's standard
  /// error, from the scatter about the line, is larger where the curve bends within the range.
  double statistical_error;
};

/// One entry for every power-law fit and group whose default variant was fitted.
std::vector<Exponent> exponents(const FitReport& report);

}  // namespace shakebed::fitting
