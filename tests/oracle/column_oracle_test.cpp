#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "files/atomic_file.hpp"
#include "tests/column/physics.hpp"
#include "tests/oracle/column_deck.hpp"
#include "tests/oracle/lammps.hpp"

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

void write_deck(const std::filesystem::path& folder, const Case& one, const LinearColumn& physics,
                const SizedGrains& grains) {
  write_data(folder / "bed.data", grains);
  std::ofstream deck(folder / "deck.in");
  write_deck_head(deck, physics, one.grain, one.wall, one.radius, 0.3);
  deck << "dump d all custom " << steps
       << " out.txt id x y z vx vy vz omegax omegay omegaz\n"
          "dump_modify d sort id format float %.17g\nthermo 1000\nrun "
       << steps << '\n';
}

SizedGrains run_lammps_bed(const std::filesystem::path& folder, const SizedGrains& start) {
  const std::string command = "cd '" + folder.string() +
                              "' && OMP_NUM_THREADS=1 lmp -in deck.in -nocite -log none "
                              "> screen.txt 2>&1";
  if (std::system(command.c_str()) != 0) {
    throw std::runtime_error("lmp failed:\n" + shakebed::files::read_text(folder / "screen.txt"));
  }
  SizedGrains end = start;
  std::ifstream out(folder / "out.txt");
  std::size_t next = start.count();
  for (std::string line; std::getline(out, line);) {
    if (line.starts_with("ITEM: ATOMS")) {
      next = 0;  // the last frame wins
      continue;
    }
    if (next >= start.count()) continue;
    std::istringstream in(line);
    std::size_t id = 0;
    in >> id;
    for (auto* columns : {&end.position, &end.velocity, &end.spin}) {
      for (auto& column : *columns) in >> column[id - 1];
    }
    ++next;
  }
  return end;
}

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
    std::string pattern =
        (std::filesystem::temp_directory_path() / "shakebed-column-XXXXXX").string();
    REQUIRE(::mkdtemp(pattern.data()) != nullptr);
    write_deck(pattern, one, physics, start);
    const auto theirs = run_lammps_bed(pattern, start);
    std::filesystem::remove_all(pattern);

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
