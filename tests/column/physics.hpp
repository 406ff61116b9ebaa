#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/beds/column_engines.hpp"
#include "simulator/grains/column_filling.hpp"

namespace shakebed::tests {

using namespace simulator;

using LinearColumn = RoughColumn<LinearOverlap>;
using HertzColumn = RoughColumn<HertzOverlap>;

/// Sun 2006, table I.
inline constexpr SpringKind table_grain{2e5, 2e5 * 2 / 7, 40, 0, 0.5};
inline constexpr SpringKind table_wall{2e5, 2e5 * 2 / 7, 40, 20, 0.5};

/// A wide cylinder, gravity, and a still base unless the test says otherwise.
template <class Physics = LinearColumn>
Physics physics_of(const SpringKind& grain, const SpringKind& wall, double time_step,
                   double radius = 50) {
  return Physics{typename Physics::Pair(grain),
                 typename Physics::Wall(wall),
                 {radius},
                 {0, 0},
                 {},
                 1,
                 time_step,
                 1'000'000};
}

template <class Physics>
Physics shaken(Physics physics, double amplitude, double angular_frequency) {
  const double period = 2 * std::numbers::pi / angular_frequency;
  physics.base = {amplitude, amplitude * angular_frequency};
  physics.steps_per_cycle = std::lround(period / physics.time_step);
  physics.time_step = period / static_cast<double>(physics.steps_per_cycle);
  return physics;
}

/// Of positions, velocities and spins.
inline double largest_difference(const SizedGrains& a, const SizedGrains& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.count(); ++i) {
    worst = std::max({worst, (row(a.position, i) - row(b.position, i)).norm(),
                      (row(a.velocity, i) - row(b.velocity, i)).norm(),
                      (row(a.spin, i) - row(b.spin, i)).norm()});
  }
  return worst;
}

/// Grains of diameter 1 and mass 1, high above the base.
inline SizedGrains two_grains(double gap) {
  SizedGrains grains;
  grains.resize_to(2);
  grains.position[0][1] = 1 + gap;
  grains.position[2] = {1e3, 1e3};
  return grains;
}

}  // namespace shakebed::tests
