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
};

/// One entry for every power-law fit and group whose default variant was fitted.
std::vector<Exponent> exponents(const FitReport& report);

}  // namespace shakebed::fitting
