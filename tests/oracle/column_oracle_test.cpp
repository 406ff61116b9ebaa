#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>

#include "tests/column/physics.hpp"
#include "tests/oracle/lammps.hpp"
#include "tests/oracle/lammps_bed.hpp"

// Beds in a shaken cylinder, grain by grain against LAMMPS' gran/hooke/history: 1000 steps from one
// state without contact memory, with LAMMPS' half-step velocities in the contact laws.
namespace {

using namespace shakebed::tests;

constexpr double tolerance = 1e-8;  // [d], [sqrt(g d)] and [sqrt(g/d)]
constexpr long steps = 1000;

struct Case {
  const char* name;
  SpringKind grain;
  SpringKind wall;
  double radius;
  int count;
};

/// A bed that falls on the base, is thrown and rubs along the wall, some time after the first blow.
SizedGrains bed_in_motion(const LinearColumn& physics, const Case& one, long first_step) {
  auto grains = fill_column({one.radius, one.count, 0.9, 1.1, true, 2.0, 7.09}, 5);
  constexpr long before = 16000;
  for (double& z : grains.position[2]) z += physics.base_at(first_step - before).height;
  for (double& v : grains.velocity[2]) v = -1.5;
  ColumnStepper<LinearColumn> mover(physics, grains, first_step - before);
  mover.advance(before);
  return mover.synchronised();
}

}  // namespace

TEST_CASE("Beds in a cylinder move grain by grain as LAMMPS moves them", "[column]") {
  if (!lammps_is_here()) {
    WARN("oracle skipped: no program lmp with the package GRANULAR on PATH");
    return;
  }
  const SpringKind rubbing{1e5, 4e4, 20, 10, 0.3};
  const Case cases[] = {{"table 1", table_grain, table_wall, 3, 150},
                        {"wide", table_grain, table_wall, 5, 300},
                        {"dashpots everywhere", rubbing, {2e5, 3e4, 50, 35, 0.8}, 3, 100},
                        {"smooth wall", table_grain, {2e5, 5e4, 40, 20, 0}, 3, 100}};
  for (const auto& one : cases) {
    auto physics = shaken(physics_of(one.grain, one.wall, 2e-4, one.radius), 1.5, 1.5);
    physics.predict_velocities = false;
    while (physics.steps_per_cycle % 4 != 0) {
      const double period = physics.time_step * static_cast<double>(physics.steps_per_cycle);
      ++physics.steps_per_cycle;
      physics.time_step = period / static_cast<double>(physics.steps_per_cycle);
    }
    // LAMMPS' walls start at their lowest: our three quarters of a cycle.
    const long first = physics.steps_per_cycle * 7 / 4;
    const auto start = bed_in_motion(physics, one, first);
    const auto theirs = run_lammps_bed(physics, one.grain, one.wall, start, steps);

    ColumnStepper<LinearColumn> fast(physics, start, first);
    ColumnReference<LinearColumn> plain(physics, start, first);
    fast.advance(steps);
    plain.advance(steps);
    for (const auto* ours : {&fast.synchronised(), &plain.synchronised()}) {
      double worst = 0;
      double moved = 0;
      for (std::size_t i = 0; i < start.count(); ++i) {
        worst = std::max({worst, (row(ours->position, i) - row(theirs.position, i)).norm(),
                          (row(ours->velocity, i) - row(theirs.velocity, i)).norm(),
                          (row(ours->spin, i) - row(theirs.spin, i)).norm()});
        moved = std::max(moved, (row(start.spin, i) - row(theirs.spin, i)).norm());
      }
      std::printf(
          "%-20s %s: largest difference %.2g after %ld steps, %ld pair and %ld wall "
          "contact steps\n",
          one.name, ours == &plain.synchronised() ? "plain" : "fast", worst, steps,
          plain.counters().pair_steps, plain.counters().wall_steps);
      CHECK(worst < tolerance);
      CHECK(moved > 0.1);
    }
    CHECK(plain.counters().pair_steps > 500);
    CHECK(plain.counters().wall_steps > 200);
    CHECK(plain.counters().pair_steps == fast.counters().pair_steps);
  }
}
