#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/column/physics.hpp"
#include "tests/oracle/lammps.hpp"
#include "tests/oracle/lammps_bed.hpp"

// Single contacts of every kind against LAMMPS' gran/hooke/history, all in one cylinder, too far
// apart to meet. LAMMPS evaluates its contacts with velocities half a step late. With the same
// (`contact_velocities: half_step`) trajectories agree to 1e-9; with ours, carried to the time of
// the positions, they differ by O(dt), and by less than 1e-6 of the speeds where dt is small
// enough: t_c/1000000 for impacts, twenty times as much for contacts that last. None begins sliding
// in contact: a spring that LAMMPS has not stretched yet gives no friction there.
namespace {

using namespace shakebed::tests;

constexpr double cylinder_radius = 12;

struct OneGrain {
  Vector<3> position, velocity, spin;
  double radius = 0.5;
  double mass = 1;
};

struct Encounter {
  std::string name;
  double speed;  ///< what differences are compared with [sqrt(g d)]
  std::vector<OneGrain> grains;
};

const double large_mass = sphere_mass(3.16, 7.09);

OneGrain large(const Vector<3>& position, const Vector<3>& velocity) {
  return {position, velocity, Vector<3>(0.2, 0.1, -0.3), 1.58, large_mass};
}

const Vector<3> none(0, 0, 0);
const Vector<3> some(0.4, -0.3, 0.6);
constexpr double orbit = cylinder_radius - 0.5;

std::vector<Encounter> impacts() {
  return {
      {"grain-grain, head-on",
       1,
       // Not a whole number of steps apart: rounding would decide in which of two they touch.
       {{{-4, -4, 20}, {0.5, 0, 0}, none}, {{-2.989997, -4, 20}, {-0.5, 0, 0}, none}}},
      {"grain-grain, oblique, sliding",
       1,
       {{{-4, 0, 20}, {0.5, 1, 0}, some}, {{-2.99, 0, 20}, {-0.5, -1, 0.4}, -some}}},
      {"grain-grain, oblique, sticking",
       1,
       {{{-4, 4, 20}, {0.5, 0.02, 0}, none}, {{-2.99, 4, 20}, {-0.5, -0.02, 0.01}, none}}},
      {"large-small",
       1,
       {large({3, 0, 20}, {0.3, 0.2, 0}), {{3 + 1.58 + 0.51, 0, 20}, {-0.6, 0.3, -0.4}, some}}},
      {"grain-base", 0.5, {{{-4, -4, 0.51}, {0, 0, -0.5}, none}}},
      {"grain-base, oblique, sliding", 0.5, {{{-4, 0, 0.51}, {1.5, 0.2, -0.5}, some}}},
      {"grain-base, oblique, sticking", 0.5, {{{-4, 4, 0.51}, {0.05, 0, -0.5}, none}}},
      {"grain-cylinder", 0.5, {{{orbit - 0.01, 0, 10}, {0.5, 0, 0}, none}}},
      {"grain-cylinder, oblique", 0.7, {{{0, orbit - 0.01, 10}, {0.5, 0.5, -0.4}, some}}},
  };
}

/// Contacts that last: the large grain's on walls (t_c = 0.14), and rolling.
std::vector<Encounter> lasting() {
  const double around = 2;
  const double pressed = around * around / orbit / table_wall.normal_stiffness;
  return {
      {"grain-base, sliding until it rolls", 0.2, {{{0, -6, 0.5}, {0.2, 0.05, 0}, none}}},
      {"grain-base, rolling", 0.2, {{{0, 6, 0.5}, {0.2, 0, 0}, {0, 0.4, 0}}}},
      {"grain-cylinder, rolling round",
       around,
       {{{-orbit - pressed, 0, 10}, {0, around, 0}, {0, 0, 2 * around}}}},
      {"large-base", 0.5, {large({3, -5, 1.59}, {0.2, 0, -0.5})}},
      {"large-cylinder", 0.5, {large({0, -(cylinder_radius - 1.59), 10}, {0.1, -0.5, 0.2})}},
  };
}

SizedGrains all_of(const std::vector<Encounter>& list) {
  SizedGrains all;
  std::size_t count = 0;
  for (const auto& one : list) count += one.grains.size();
  all.resize_to(count);
  std::size_t i = 0;
  for (const auto& one : list) {
    for (const auto& grain : one.grains) {
      set_row(all.position, i, grain.position);
      set_row(all.velocity, i, grain.velocity);
      set_row(all.spin, i, grain.spin);
      all.radius[i] = grain.radius;
      all.mass[i] = grain.mass;
      ++i;
    }
  }
  return all;
}

LinearColumn still(double time_step, bool half_step) {
  auto physics = physics_of(table_grain, table_wall, time_step, cylinder_radius);
  physics.predict_velocities = !half_step;
  return physics;
}

/// Largest difference of positions [d], velocities and rim velocities, over the encounter's speed.
double largest_difference(const Encounter& one, std::size_t first, const SizedGrains& a,
                          const SizedGrains& b) {
  double worst = 0;
  for (std::size_t i = first; i < first + one.grains.size(); ++i) {
    worst = std::max({worst, (row(a.position, i) - row(b.position, i)).norm(),
                      (row(a.velocity, i) - row(b.velocity, i)).norm() / one.speed,
                      a.radius[i] * (row(a.spin, i) - row(b.spin, i)).norm() / one.speed});
  }
  return worst;
}

std::vector<double> differences(const std::vector<Encounter>& list, double time_step, double lasts,
                                bool half_step) {
  const auto start = all_of(list);
  const auto physics = still(time_step, half_step);
  const long steps = std::lround(lasts / time_step);
  ColumnStepper<LinearColumn> ours(physics, start);
  ours.advance(steps);
  const auto theirs = run_lammps_bed(physics, table_grain, table_wall, start, steps);
  std::vector<double> found;
  std::size_t first = 0;
  for (const auto& one : list) {
    found.push_back(largest_difference(one, first, ours.synchronised(), theirs));
    // Something must have happened: 1 % of the speed at least.
    CHECK(largest_difference(one, first, start, theirs) > 0.01);
    first += one.grains.size();
  }
  return found;
}

void compare(const std::vector<Encounter>& list, double lasts, double coarse, double fine) {
  const auto same_scheme = differences(list, 1e-5, lasts, true);
  const auto ours = differences(list, coarse, lasts, false);
  const auto halved = differences(list, 0.5 * coarse, lasts, false);
  const auto small = differences(list, fine, lasts, false);
  for (std::size_t k = 0; k < list.size(); ++k) {
    std::printf("%-36s half-step %.1e; ours at dt = %.0e %.2e, half of it %.2e, %.0e %.1e\n",
                list[k].name.c_str(), same_scheme[k], coarse, ours[k], halved[k], fine, small[k]);
    INFO(list[k].name);
    CHECK(same_scheme[k] < 1e-9);
    CHECK(small[k] < 1e-6);
    CHECK(halved[k] < 0.75 * ours[k]);
    CHECK(halved[k] > 0.25 * ours[k]);
  }
}

}  // namespace

TEST_CASE("Single contacts of every kind go as in LAMMPS", "[single]") {
  if (!lammps_is_here()) {
    WARN("oracle skipped: no program lmp with the package GRANULAR on PATH");
    return;
  }
  SECTION("impacts") { compare(impacts(), 0.035, 2e-6, 5e-9); }
  SECTION("contacts that last") { compare(lasting(), 0.2, 2e-6, 1e-7); }
}
