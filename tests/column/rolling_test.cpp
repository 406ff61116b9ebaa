#include <catch2/catch.hpp>
#include <cmath>

#include "tests/column/physics.hpp"

namespace {

using namespace shakebed::tests;

SizedGrains one_grain(double x, double z) {
  SizedGrains grains;
  grains.resize_to(1);
  grains.position[0][0] = x;
  grains.position[2][0] = z;
  return grains;
}

}  // namespace

// Friction mu g slows the centre and spins the grain until it rolls, at t = (2/7) v_0/(mu g) and
// with (5/7) v_0, whatever mu is: angular momentum about the contact.
TEST_CASE("A grain thrown along the base slides, then rolls with 5/7 of its speed") {
  SpringKind wall = table_wall;
  for (const double friction : {0.1, 0.5}) {
    wall.friction = friction;
    auto physics = physics_of(table_grain, wall, 1e-4, 30);
    auto start = one_grain(0, 0.5 - 1 / wall.normal_stiffness);
    start.velocity[0][0] = 2;
    ColumnStepper<LinearColumn> bed(physics, start);
    const double rolls_from = 2.0 / 7 * 2 / friction;
    bed.advance(std::lround(0.5 * rolls_from / physics.time_step));
    CHECK(bed.synchronised().velocity[0][0] ==
          Approx(2 - friction * 0.5 * rolls_from).epsilon(2e-3));
    bed.advance(std::lround(rolls_from / physics.time_step));
    const auto& end = bed.synchronised();
    CHECK(end.velocity[0][0] == Approx(10.0 / 7).epsilon(2e-3));
    CHECK(end.spin[1][0] * 0.5 == Approx(end.velocity[0][0]).epsilon(1e-3));
  }
}

// A sphere that rolls round inside an upright cylinder at angular rate Omega does not run away
// downwards but bobs, the golfer's dilemma (Gualtieri et al., Am. J. Phys. 74, 497 (2006)):
//   z'' = -(5/7) g - (2/7) Omega^2 z,  z(t) = -(5 g/(2 Omega^2)) (1 - cos(sqrt(2/7) Omega t)),
// which holds while z is counted from where it rolled level, with no spin about the wall's normal.
TEST_CASE("A grain rolling down the cylinder comes back up") {
  SpringKind wall = table_wall;
  wall.friction = 2;
  const double radius = 10;
  const double orbit = radius - 0.5;
  const double Omega = 3;
  auto physics = physics_of(table_grain, wall, 2e-5, radius);
  const double pressed = Omega * Omega * orbit / wall.normal_stiffness;
  auto start = one_grain(orbit + pressed, 100);
  start.velocity[1][0] = Omega * (orbit + pressed);
  start.spin[2][0] = -start.velocity[1][0] / 0.5;  // rolls: v + omega x a n = 0 at the wall
  ColumnStepper<LinearColumn> bed(physics, start);
  const double rate = std::sqrt(2.0 / 7) * Omega;
  const double depth = 5 / (2 * Omega * Omega);
  const double turn = 2 * std::numbers::pi / rate;
  double lowest = 0;
  for (int k = 1; k <= 16; ++k) {
    bed.advance(std::lround(turn / 16 / physics.time_step));
    const double t = static_cast<double>(bed.step_number()) * physics.time_step;
    const double z = bed.synchronised().position[2][0] - 100;
    lowest = std::min(lowest, z);
    CHECK(z == Approx(-depth * (1 - std::cos(rate * t))).margin(0.02 * depth));
  }
  CHECK(lowest < -1.9 * depth);
}

TEST_CASE("Without wall friction the grain falls freely beside the cylinder") {
  SpringKind wall = table_wall;
  wall.friction = 0;
  auto physics = physics_of(table_grain, wall, 1e-4, 10);
  auto start = one_grain(9.5, 100);
  start.velocity[1][0] = 3;
  ColumnStepper<LinearColumn> bed(physics, start);
  bed.advance(10000);
  const auto& end = bed.synchronised();
  CHECK(end.position[2][0] == Approx(99.5).epsilon(1e-6));
  CHECK(end.spin[2][0] == 0);
}
