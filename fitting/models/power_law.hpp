#pragma once

#include <cmath>

#include "fitting/models/model.hpp"

namespace shakebed::fitting {

/// y = C x^alpha, x > 0. Bhateja et al. 2016 (doi 10.1063/1.4944795), Eq. 1 for T_z(V_p) and
/// Eq. 2 (alpha_h) for the shift of the centre of mass.
struct PowerLaw {
  static constexpr std::string_view name = "power_law";
  static constexpr std::array<std::string_view, 2> parameters{"C", "alpha"};
  static constexpr std::size_t linear_count = 1;
  static constexpr std::size_t nonlinear = 1;
  static constexpr bool positive_x = true;

  static std::array<double, 1> basis(double x, double alpha) { return {std::pow(x, alpha)}; }
  static std::array<double, 2> assemble(double alpha, const std::array<double, 1>& coefficient) {
    return {coefficient[0], alpha};
  }
  static double value(double x, const std::array<double, 2>& p) {
    const auto [C, alpha] = p;
    return C * std::pow(x, alpha);
  }
  static std::array<double, 2> gradient(double x, const std::array<double, 2>& p) {
    const auto [C, alpha] = p;
    const double power = std::pow(x, alpha);
    return {power, C * power * std::log(x)};
  }
  static SearchInterval search(const std::vector<double>&) { return {-20, 20, false}; }
  static std::array<std::string, 2> units(const std::string& x, const std::string& y) {
    return {x == "1" ? y : y + "/(" + x + ")^alpha", "1"};
  }
};

}  // namespace shakebed::fitting
