#pragma once

#include <cmath>

#include "fitting/models/model.hpp"

namespace shakebed::fitting {

/// y = a (1 + c W^-b), W > 0, b > 0: the decay of T_z/(m V_p^2) past its peak to the constant a.
/// Bhateja et al. 2016, Sec. IV and Table III. Times V_p^2 it is Eq. 6 with c_1 = a, c_2 = a c and
/// alpha = 2 - 2 b, so the two differ only in how their residuals are weighted.
struct Algebraic {
  static constexpr std::string_view name = "algebraic";
  static constexpr std::array<std::string_view, 3> parameters{"a", "b", "c"};
  static constexpr std::size_t linear_count = 2;
  static constexpr std::size_t nonlinear = 1;
  static constexpr bool positive_x = true;

  static std::array<double, 2> basis(double W, double b) { return {1, std::pow(W, -b)}; }
  static std::array<double, 3> assemble(double b, const std::array<double, 2>& coefficients) {
    const auto [a, ac] = coefficients;
    return {a, b, ac / a};
  }
  static double value(double W, const std::array<double, 3>& p) {
    const auto [a, b, c] = p;
    return a * (1 + c * std::pow(W, -b));
  }
  static std::array<double, 3> gradient(double W, const std::array<double, 3>& p) {
    const auto [a, b, c] = p;
    const double decay = std::pow(W, -b);
    return {1 + c * decay, -a * c * decay * std::log(W), a * decay};
  }
  static SearchInterval search(const std::vector<double>&) { return {1e-3, 20, true}; }
  static std::array<std::string, 3> units(const std::string& x, const std::string& y) {
    return {y, "1", x == "1" ? "1" : "(" + x + ")^b"};
  }
};

}  // namespace shakebed::fitting
