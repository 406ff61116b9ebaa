#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/least_squares.hpp"
#include "tests/fitting/table3.hpp"

using namespace shakebed::fitting;

namespace {

std::vector<double> some_parameters(const Model& model) {
  if (model.name == "power_law") return {0.7, 1.49};
  if (model.name == "two_power" || model.name == "two_power_scaled") return {0.14, 0.29, 0.69};
  return {0.282, 0.656, 2.07};
}

}  // namespace

TEST_CASE("every model's gradient is its value's slope", "[models]") {
  for (const auto& model : all_models()) {
    const auto values = some_parameters(model);
    std::vector<double> slope(values.size());
    for (double x : {0.8, 2.0, 9.4}) {
      model.gradient(x, values, slope);
      for (std::size_t k = 0; k < values.size(); ++k) {
        INFO(model.name << " d/d" << model.parameters[k] << " at " << x);
        const double h = 1e-5;
        auto up = values, down = values;
        up[k] += h;
        down[k] -= h;
        // central difference: error O(h^2) = 1e-10 times a third derivative of order 10
        CHECK(slope[k] ==
              Approx((model.value(x, up) - model.value(x, down)) / (2 * h)).epsilon(1e-7));
      }
    }
  }
}

TEST_CASE("basis and coefficients assemble to the printed parameters", "[models]") {
  for (const auto& model : all_models()) {
    INFO(model.name);
    const std::vector<double> coefficients{0.3, 0.8};
    const double nonlinear = 0.6;
    const auto values = model.assemble(nonlinear, coefficients);
    CHECK(values[model.nonlinear] == nonlinear);
    std::vector<double> basis(model.linear_count);
    for (double x : {0.8, 2.0, 9.4}) {
      model.basis(x, nonlinear, basis);
      double sum = 0;
      for (std::size_t j = 0; j < basis.size(); ++j) sum += coefficients[j] * basis[j];
      CHECK(model.value(x, values) == Approx(sum).epsilon(1e-14));
    }
  }
}

TEST_CASE("Table III's algebraic form times V_p^2 is Eq. 6 with alpha = 2 - 2b", "[models]") {
  // a (1 + c W^-b) V_p^2 = a V_p^2 + a c V_p^(2 - 2b), since W = V_p^2 in units of d g
  const double a = 0.282, b = 0.656, c = 2.07;
  for (double V_p : {1.5, 3.0, 9.0}) {
    const double W = V_p * V_p;
    const std::array<double, 3> equation6{a, a * c, 2 - 2 * b};
    CHECK(Algebraic::value(W, {a, b, c}) * W ==
          Approx(TwoPower::value(V_p, equation6)).epsilon(1e-14));
    CHECK(Algebraic::value(W, {a, b, c}) ==
          Approx(TwoPowerScaled::value(V_p, equation6)).epsilon(1e-14));
  }
}
