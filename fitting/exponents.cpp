#include "fitting/exponents.hpp"

#include <algorithm>

namespace shakebed::fitting {
namespace {

double alpha_of(const FitResult& result) {
  return result.fit.values[result.specification.model.nonlinear];
}

void include(Spread& spread, double alpha) {
  spread.low = std::min(spread.low, alpha);
  spread.high = std::max(spread.high, alpha);
}

void include(Exponent& exponent, const FitResult& result) {
  const double alpha = alpha_of(result);
  const auto& standard = exponent.by_default->variant;
  const auto& variant = result.variant;
  ++exponent.variants;
  include(exponent.over_all, alpha);
  if (variant.stretch_from == 1 && variant.stretch_to == 1) include(exponent.over_methods, alpha);
  if (variant.method == standard.method && variant.weights == standard.weights) {
    include(exponent.over_ranges, alpha);
  }
}

}  // namespace

std::vector<Exponent> exponents(const FitReport& report) {
  std::vector<Exponent> all;
  for (const auto& result : report.fits) {
    if (!result.fitted() || !result.variant.is_default) continue;
    if (result.specification.model.name != "power_law") continue;
    const double alpha = alpha_of(result);
    const Spread alone{alpha, alpha};
    const auto& points = result.measurements.points;
    const auto [first, last] = std::ranges::minmax(points, {}, &Point::W);
    Exponent exponent{&result, alone, alone, alone, 0, {first.W, last.W}};
    for (const auto& other : report.fits) {
      const bool sibling = other.specification.id == result.specification.id &&
                           other.labels == result.labels && other.fitted();
      if (sibling) include(exponent, other);
    }
    all.push_back(exponent);
  }
  return all;
}

}  // namespace shakebed::fitting
