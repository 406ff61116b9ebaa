#include "fitting/exponents.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace shakebed::fitting {
namespace {

double alpha_of(const FitResult& result) {
  return result.fit.values[result.specification.model.nonlinear];
}

/// Of y = C x^alpha. With g_i the gradient at point i and weights w_i, least squares moves the
/// parameters by A^-1 sum_i w_i g_i dy_i, A = sum_i w_i g_i g_i^T; where ln y is fitted, g_i and
/// dy_i are those of ln y.
double error_from_points(const FitResult& result) {
  const auto& model = result.specification.model;
  const bool logarithms = result.variant.method == Method::log_log;
  const auto& points = result.measurements.points;
  std::vector<std::array<double, 2>> gradients;
  double cc = 0, ca = 0, aa = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<double, 2> g{};
    model.gradient(points[i].x, result.fit.values, g);
    if (logarithms) {
      for (double& part : g) part /= result.fit.fitted[i];
    }
    const double w = result.weights[i];
    cc += w * g[0] * g[0];
    ca += w * g[0] * g[1];
    aa += w * g[1] * g[1];
    gradients.push_back(g);
  }
  double variance = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double sigma = points[i].error / (logarithms ? points[i].y : 1);
    const auto [g_C, g_alpha] = gradients[i];
    const double slope = result.weights[i] * (cc * g_alpha - ca * g_C) / (cc * aa - ca * ca);
    variance += slope * slope * sigma * sigma;
  }
  return std::sqrt(variance);
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
    Exponent exponent{
        &result, alone, alone, alone, 0, {first.W, last.W}, error_from_points(result)};
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
