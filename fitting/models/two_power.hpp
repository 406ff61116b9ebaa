#pragma once

#include <cmath>

#include "fitting/models/model.hpp"

namespace shakebed::fitting {

/// T_z = c_1 V_p^2 + c_2 V_p^alpha, 0 < alpha < 2. Bhateja et al. 2016, Eq. 6.
struct TwoPower {
  static constexpr std::string_view name = "two_power";
  static constexpr std::array<std::string_view, 3> parameters{"c_1", "c_2", "alpha"};
  static constexpr std::size_t linear_count = 2;
  static constexpr std::size_t nonlinear = 2;
  static constexpr bool positive_x = true;

  static std::array<double, 2> basis(double V_p, double alpha) {
    return {V_p * V_p, std::pow(V_p, alpha)};
  }
  static std::array<double, 3> assemble(double alpha, const std::array<double, 2>& coefficients) {
    return {coefficients[0], coefficients[1], alpha};
  }
  static double value(double V_p, const std::array<double, 3>& p) {
    const auto [c_1, c_2, alpha] = p;
    return c_1 * V_p * V_p + c_2 * std::pow(V_p, alpha);
  }
  static std::array<double, 3> gradient(double V_p, const std::array<double, 3>& p) {
    const auto [c_1, c_2, alpha] = p;
    const double power = std::pow(V_p, alpha);
    return {V_p * V_p, power, c_2 * power * std::log(V_p)};
  }
  static SearchInterval search(const std::vector<double>&) { return {1e-3, 2 - 1e-3, false}; }
  static std::array<std::string, 3> units(const std::string& x, const std::string& y) {
    if (x == "1") return {y, y, "1"};
    return {y + "/(" + x + ")^2", y + "/(" + x + ")^alpha", "1"};
  }
};

/// Eq. 6 over V_p^2: T_z/(m V_p^2) = c_1 + c_2 V_p^(alpha - 2), so that it can be judged (AIC) on
/// the same column as the algebraic and the exponential form.
struct TwoPowerScaled {
  static constexpr std::string_view name = "two_power_scaled";
  static constexpr auto parameters = TwoPower::parameters;
  static constexpr std::size_t linear_count = 2;
  static constexpr std::size_t nonlinear = 2;
  static constexpr bool positive_x = true;

  static std::array<double, 2> basis(double V_p, double alpha) {
    return {1, std::pow(V_p, alpha - 2)};
  }
  static std::array<double, 3> assemble(double alpha, const std::array<double, 2>& coefficients) {
    return TwoPower::assemble(alpha, coefficients);
  }
  static double value(double V_p, const std::array<double, 3>& p) {
    return TwoPower::value(V_p, p) / (V_p * V_p);
  }
  static std::array<double, 3> gradient(double V_p, const std::array<double, 3>& p) {
    auto slope = TwoPower::gradient(V_p, p);
    for (double& s : slope) s /= V_p * V_p;
    return slope;
  }
  static SearchInterval search(const std::vector<double>& xs) { return TwoPower::search(xs); }
  static std::array<std::string, 3> units(const std::string& x, const std::string& y) {
    return {y, x == "1" ? y : y + " (" + x + ")^(2 - alpha)", "1"};
  }
};

}  // namespace shakebed::fitting
