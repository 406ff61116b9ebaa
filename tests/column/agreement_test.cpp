#include <catch2/catch.hpp>
#include <cmath>

#include "tests/column/physics.hpp"

// The fast stepper against the plain one. Rounding differs, and granular beds are chaotic, so the
// comparison ends while 1e-16 has not yet grown to the tolerance; contacts must be the same to the
// step until then.
namespace {

using namespace shakebed::tests;

constexpr double tolerance = 1e-7;

SizedGrains some_bed(double radius, int count, double base_speed) {
  auto grains = fill_column({radius, count, 0.9, 1.1, true, 2.0, 7.09}, 5);
  RandomStream random(7, RandomPurpose::thermal_velocities);
  for (std::size_t i = 0; i < grains.count(); ++i) {
    set_row(grains.velocity, i,
            Vector<3>(random.normal(), random.normal(), base_speed - 3 + random.normal()));
  }
  return grains;
}

template <class Physics>
void compare(const Physics& physics, const SizedGrains& start, long steps) {
  ColumnReference<Physics> plain(physics, start);
  ColumnStepper<Physics> fast(physics, start);
  constexpr int looks = 20;
  for (int look = 0; look < looks; ++look) {
    plain.advance(steps / looks);
    fast.advance(steps / looks);
    const auto& a = plain.synchronised();
    const auto& b = fast.synchronised();
    REQUIRE(largest_difference(a, b) < tolerance);
    REQUIRE(plain.counters().pair_steps == fast.counters().pair_steps);
    REQUIRE(plain.counters().wall_steps == fast.counters().wall_steps);
    auto ours = fast.contacts();
    auto theirs = plain.contacts();
    REQUIRE(ours.size() == theirs.size());
    const auto by_grains = [](const ColumnContact& x, const ColumnContact& y) {
      return x.i != y.i ? x.i < y.i : x.j < y.j;
    };
    std::sort(ours.begin(), ours.end(), by_grains);
    std::sort(theirs.begin(), theirs.end(), by_grains);
    for (std::size_t k = 0; k < ours.size(); ++k) {
      REQUIRE(ours[k].i == theirs[k].i);
      REQUIRE(ours[k].j == theirs[k].j);
      REQUIRE(std::abs(ours[k].memory.z - theirs[k].memory.z) < tolerance);
      REQUIRE(std::abs(ours[k].normal_force - theirs[k].normal_force) < tolerance * 2e5);
    }
  }
  CHECK(fast.counters().pair_steps > 3000);
  CHECK(fast.counters().wall_steps > 1000);
  CHECK(fast.counters().largest_overlap ==
        Approx(plain.counters().largest_overlap).margin(tolerance));
}

template <class Physics>
Physics bed_physics() {
  return shaken(physics_of<Physics>(table_grain, table_wall, 2e-4, 3.0), 1.5, 1.5);
}

template <class Overlap>
using SmoothGrains = ColumnPhysics<Overlap, Frictionless, CundallStrack>;
template <class Overlap>
using SmoothWall = ColumnPhysics<Overlap, CundallStrack, Frictionless>;
template <class Overlap>
using Smooth = ColumnPhysics<Overlap, Frictionless, Frictionless>;

}  // namespace

TEMPLATE_TEST_CASE("The fast stepper moves grains as the plain one does", "", LinearColumn,
                   HertzColumn, SmoothGrains<LinearOverlap>, SmoothWall<LinearOverlap>,
                   Smooth<LinearOverlap>) {
  const auto physics = bed_physics<TestType>();
  compare(physics, some_bed(3.0, 150, physics.base.peak_velocity), 4000);
}

TEST_CASE("They agree with drag, in the co-moving frame, and with LAMMPS' velocities") {
  auto physics = bed_physics<LinearColumn>();
  SECTION("drag") { physics.drag = {0.24, 0.01, 0.6}; }
  SECTION("frame") { physics.co_moving = true; }
  SECTION("half-step velocities") { physics.predict_velocities = false; }
  SECTION("a short list of neighbours") { physics.list_skin = 0.1; }
  SECTION("a long list of neighbours") { physics.list_skin = 1.5; }
  const double speed = physics.co_moving ? 0 : physics.base.peak_velocity;
  compare(physics, some_bed(3.0, 150, speed), 4000);
}

TEST_CASE("A hundred grains that rest on one another keep their springs through list rebuilds") {
  auto physics = bed_physics<LinearColumn>();
  physics.base = {0, 0};
  auto start = fill_column({3.0, 100, 0.9, 1.1, true, 2.0, 7.09}, 5);
  ColumnStepper<LinearColumn> poured(physics, start);
  poured.advance(60000);
  const long builds = poured.lists().outer_builds;
  std::vector<ContactMemory> memory;
  double longest = 0;
  for (const auto& c : poured.contacts()) {
    memory.push_back({c.i, c.j, c.memory});
    longest = std::max(longest, dot(c.memory, c.memory));
  }
  CHECK(builds > 10);
  REQUIRE(longest > 0);

  // The same bed taken up anew: memory goes by grain, whatever the rows are called.
  const SizedGrains at_rest = poured.synchronised();
  ColumnReference<LinearColumn> plain(physics, at_rest, poured.step_number(), memory);
  ColumnStepper<LinearColumn> fast(physics, at_rest, poured.step_number(), memory);
  ColumnStepper<LinearColumn> forgetful(physics, at_rest, poured.step_number());
  for (auto* bed : {&poured, &fast, &forgetful}) bed->advance(200);
  plain.advance(200);
  double worst = 0;
  double forgotten = 0;
  for (std::size_t i = 0; i < at_rest.count(); ++i) {
    const auto x = row(poured.synchronised().position, i);
    worst = std::max(worst, (row(plain.synchronised().position, i) - x).norm());
    worst = std::max(worst, (row(fast.synchronised().position, i) - x).norm());
    forgotten = std::max(forgotten, (row(forgetful.synchronised().position, i) - x).norm());
  }
  // Taking a bed up computes its first forces at full instead of predicted velocities: O(dt^2).
  CHECK(worst < 1e-8);
  CHECK(forgotten > 1e-6);
}
