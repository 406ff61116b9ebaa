#pragma once

#include <cmath>

#include "fitting/models/model.hpp"

namespace shakebed::fitting {

/// y = a (1 + c exp(-b W)), b > 0: the rival of the algebraic decay in Table III of Bhateja et
/// al. 2016.
struct Exponential {
  static constexpr std::string_view name = "exponential";
  static constexpr std::array<std::string_view, 3> parameters{"a", "b", "c"};
  static constexpr std::size_t linear_count = 2;
  static constexpr std::size_t nonlinear = 1;
  static constexpr bool positive_x = false;

  static std::array<double, 2> basis(double W, double b) { return {1, std::exp(-b * W)}; }
  static std::array<double, 3> assemble(double b, const std::array<double, 2>& coefficients) {
    const auto [a, ac] = coefficients;
    return {a, b, ac / a};
  }
  static double value(double W, const std::array<double, 3>& p) {
    const auto [a, b, c] = p;
    return a * (1 + c * std::exp(-b * W));
  }
  static std::array<double, 3> gradient(double W, const std::array<double, 3>& p) {
    const auto [a, b, c] = p;
    const double decay = std::exp(-b * W);
    return {1 + c * decay, -a * c * W * decay, a * decay};
  }
  /// From a decay too slow to be told from a straight line over the data to one that is over
  /// between the first two points (xs ascending, not all equal).
  static SearchInterval search(const std::vector<double>& xs) {
    double first_step = 0;
    for (std::size_t i = 1; i < xs.size() && first_step == 0; ++i) first_step = xs[i] - xs[0];
    return {1e-3 / (xs.back() - xs.front()), 20 / first_step, true};
  }
  static std::array<std::string, 3> units(const std::string& x, const std::string& y) {
    return {y, x == "1" ? "1" : "1/(" + x + ")", "1"};
  }
};

}  // namespace shakebed::fitting
