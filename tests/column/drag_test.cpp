#include <catch2/catch.hpp>
#include <cmath>

#include "tests/column/physics.hpp"

namespace {

using namespace shakebed::tests;

SizedGrains thrown(double mass) {
  auto grains = two_grains(5);
  grains.mass[1] = mass;
  for (const int i : {0, 1}) {
    grains.velocity[0][i] = 0.3;
    grains.velocity[2][i] = 2;
  }
  return grains;
}

}  // namespace

// m v' = -m g - b v: v_z = (v_0 + m g/b) exp(-b t/m) - m g/b, v_x = v_0 exp(-b t/m).
TEST_CASE("Background damping follows its closed form, for each mass its own") {
  auto physics = physics_of(table_grain, table_wall, 2e-4);
  const double b = physics.drag.background = 0.24;
  ColumnStepper<LinearColumn> bed(physics, thrown(3));
  bed.advance(15000);
  const double t = 3;
  for (const int i : {0, 1}) {
    const double m = i == 0 ? 1 : 3;
    const double decay = std::exp(-b * t / m);
    CHECK(bed.synchronised().velocity[2][i] == Approx((2 + m / b) * decay - m / b).epsilon(1e-6));
    CHECK(bed.synchronised().velocity[0][i] == Approx(0.3 * decay).epsilon(1e-6));
  }
}

// In a container that moves at V_p cos(omega t) a grain with drag rate r = b/(m (1 - phi)) obeys
// v' = -g - r (v - V_p cos omega t): v -> -g/r + V_p (cos theta) cos(omega t - theta) in the long
// run, with tan theta = omega/r.
TEST_CASE("Air drags a grain along with the container") {
  auto physics = shaken(physics_of(table_grain, table_wall, 2e-4), 0.5, 2);
  physics.drag.air = 0.6;
  physics.drag.air_packing_fraction = 0.4;
  auto start = thrown(1);
  for (double& z : start.position[2]) z = 1e5;
  ColumnStepper<LinearColumn> bed(physics, start);
  bed.advance(10 * physics.steps_per_cycle);
  const double r = 0.6 / 0.6;
  const double theta = std::atan2(2.0, r);
  for (int k = 0; k < 4; ++k) {
    bed.advance(physics.steps_per_cycle / 4);
    const double phase = 2 * std::numbers::pi * static_cast<double>(bed.step_number()) /
                         static_cast<double>(physics.steps_per_cycle);
    CHECK(bed.synchronised().velocity[2][0] ==
          Approx(-1 / r + 1.0 * std::cos(theta) * std::cos(phase - theta)).margin(2e-4));
  }
}
