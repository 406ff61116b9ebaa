#include <catch2/catch.hpp>

#include "tests/column/physics.hpp"

using namespace shakebed::tests;

// In the container's frame the base rests and gravity is g + d^2 z_b/dt^2. Positions of both frames
// then differ by z_b(t), until chaos has had its time.
TEST_CASE("A bed moves alike in the laboratory and in the container's frame") {
  auto lab_physics = shaken(physics_of(table_grain, table_wall, 5e-5, 3.0), 1.5, 1.5);
  auto moving_physics = lab_physics;
  moving_physics.co_moving = true;
  SECTION("and background damping is against the laboratory in both") {
    lab_physics.drag.background = moving_physics.drag.background = 0.24;
  }
  auto start = fill_column({3.0, 60, 0.9, 1.1, true, 2.0, 7.09}, 5);
  for (double& v : start.velocity[2]) v = -2;
  ColumnStepper<LinearColumn> moving(moving_physics, start);
  for (double& v : start.velocity[2]) v += lab_physics.base.peak_velocity;
  ColumnStepper<LinearColumn> lab(lab_physics, start);
  for (int look = 0; look < 10; ++look) {
    lab.advance(500);
    moving.advance(500);
    const auto base = lab_physics.base_at(lab.step_number());
    double worst = 0;
    for (std::size_t i = 0; i < start.count(); ++i) {
      const Vector<3> apart =
          row(lab.synchronised().position, i) - row(moving.synchronised().position, i);
      worst = std::max(worst, (apart - Vector<3>(0, 0, base.height)).norm());
    }
    REQUIRE(worst < 2e-5);
    REQUIRE(lab.counters().wall_steps == Approx(moving.counters().wall_steps).epsilon(0.01));
  }
  CHECK(lab.counters().pair_steps > 1500);
  CHECK(lab.counters().wall_steps > 1000);
}
