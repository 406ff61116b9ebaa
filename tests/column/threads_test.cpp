#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "simulator/motion/column/archive.hpp"
#include "sweeps/thread_team.hpp"
#include "tests/column/physics.hpp"

// Threads within one bed: the same bytes for any number of them, and those of the plain stepper's
// motion to rounding when lists are cut into blocks.
namespace {

using namespace shakebed::tests;
using shakebed::sweeps::ThreadTeam;

/// Four blocks, falling on the moving base. A large grain, whose pairs no block reckons with.
SizedGrains tall_bed() {
  auto grains = fill_column({4.0, 1700, 0.9, 1.1, true, 2.0, 7.09}, 5);
  RandomStream random(7, RandomPurpose::thermal_velocities);
  for (std::size_t i = 0; i < grains.count(); ++i) {
    set_row(grains.velocity, i, Vector<3>(random.normal(), random.normal(), random.normal() - 5));
  }
  return grains;
}

LinearColumn tall_physics() {
  return shaken(physics_of(table_grain, table_wall, 2e-4, 4.0), 1.5, 1.5);
}

std::string bytes_after(long steps, Crew* crew) {
  ColumnStepper<LinearColumn> bed(tall_physics(), tall_bed(), 0, {}, -1, crew);
  bed.advance(steps / 3);  // the crew is asked at the end of each stretch too
  bed.advance(steps - steps / 3);
  REQUIRE(bed.counters().pair_steps > 20 * steps);
  ByteWriter writer;
  bed.archive(writer);
  return std::move(writer).take();
}

}  // namespace

TEST_CASE("A bed has the same bytes for any number of threads") {
  REQUIRE(BlockCuts(1701).count() == 4);
  constexpr long steps = 3000;
  const auto alone = bytes_after(steps, nullptr);
  for (const int threads : {1, 2, 3, 6}) {
    CAPTURE(threads);
    ThreadTeam team(threads);
    CHECK((bytes_after(steps, &team) == alone));
  }
}

TEST_CASE("Blocks move grains as the plain stepper does") {
  const auto physics = tall_physics();
  const auto start = tall_bed();
  ColumnReference<LinearColumn> plain(physics, start);
  ColumnStepper<LinearColumn> blocks(physics, start);
  for (int look = 0; look < 7; ++look) {
    plain.advance(250);
    blocks.advance(250);
    const auto& a = plain.synchronised();
    const auto& b = blocks.synchronised();
    REQUIRE(largest_difference(a, b) <
            1e-7);  // 3e-8 at the end, growing threefold from look to look
    REQUIRE(plain.counters().pair_steps == blocks.counters().pair_steps);
    REQUIRE(plain.counters().wall_steps == blocks.counters().wall_steps);
  }
  CHECK(blocks.counters().pair_steps > 20000);
}

TEST_CASE("A team does every part once, however long its threads have slept") {
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    for (int round = 0; round < 200; ++round) {
      std::vector<int> done(7, 0);
      team.share(done.size(), [&](std::size_t part) { ++done[part]; });
      REQUIRE((done == std::vector<int>(7, 1)));
      if (round % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(3));
    }
  }
}

TEST_CASE("An error in one part is thrown where the work was shared out, and the team lives on") {
  ThreadTeam team(3);
  for (const std::size_t bad : {0, 1, 2}) {
    const auto work = [bad](std::size_t part) {
      if (part == bad) throw std::runtime_error("part");
    };
    CHECK_THROWS_AS(team.share(3, work), std::runtime_error);
    CHECK_NOTHROW(team.share(3, [](std::size_t) {}));
  }
}
