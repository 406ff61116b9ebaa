#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "files/error.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/run_bed_definition.hpp"
#include "simulator/scene/read_scene.hpp"

// What handing the bed to and fro costs: the event engine as it is, beside the same engine that
// never leaves the dense stepper and the same one that never goes there. Bhateja's rough bed of 100
// grains in three dimensions, k_n = clamp(4e4 W, 1e5, 1e6), without observables. The three start
// from the same settled bed and go on in turns of a few cycles, so that a clock that swings by half
// from second to second swings for all; the ratio is that of their CPU times summed over the turns,
// since a plug may land hard in one and softly in the next.
namespace {

using namespace shakebed;
using namespace shakebed::simulator;
using Physics = BedPhysics<3, ViscousCoulomb>;

constexpr double always = std::numeric_limits<double>::infinity();

struct Contestant {
  const char* name;
  HandOver limits;
  double seconds = 0;
  std::unique_ptr<EventEngine<Physics>> mover = {};
};

struct Row {
  double W;
  long cycles;  ///< of one turn
};

double seconds_for(EventEngine<Physics>& mover, long steps) {
  const double started = thread_cpu_seconds();
  mover.advance(steps);
  return thread_cpu_seconds() - started;
}

void compare(const Row& row, int turns) {
  std::array<Contestant, 3> contestants{
      {{"engine", {}}, {"always dense", {0, 0, -1}}, {"events only", {always, always, always}}}};
  using files::number_text;
  const auto scene = read_scene(
      SHAKEBED_ROUGH_BED, {{"base.drive.W", number_text(row.W)},
                           {"contact.stiffness", number_text(std::clamp(4e4 * row.W, 1e5, 1e6))}});
  const Parameters p = bind_parameters(scene);
  const auto physics = bind_physics<Physics>(scene, p);
  const auto bed = settle<Physics>(scene, {});
  for (auto& contestant : contestants) {
    contestant.mover = std::make_unique<EventEngine<Physics>>(
        physics, p, bed.grains, ContactOperator::closed, contestant.limits);
    contestant.mover->advance(std::max(5L, row.cycles) * p.steps_per_cycle);
  }
  for (int turn = 0; turn < turns; ++turn) {
    for (auto& contestant : contestants) {
      contestant.seconds += seconds_for(*contestant.mover, row.cycles * p.steps_per_cycle);
    }
  }
  const double better = std::min(contestants[1].seconds, contestants[2].seconds);
  std::printf("%7.4g", row.W);
  for (const auto& contestant : contestants) {
    std::printf(" %14.4g", 1000 * contestant.seconds / static_cast<double>(row.cycles * turns));
  }
  std::printf(" %14.3f\n", contestants[0].seconds / better);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int turns = argc > 1 ? std::max(1, std::atoi(argv[1])) : 30;
    std::printf("CPU ms per cycle, %d turns summed\n%7s %14s %14s %14s %14s\n", turns, "W",
                "engine", "always dense", "events only", "over better");
    for (const Row row : {Row{0.9, 1}, {1.5, 2}, {2, 4}, {3, 5}, {5.6, 5}, {22.36, 20}}) {
      compare(row, turns);
    }
    return 0;
  } catch (const files::Error& error) {
    std::fprintf(stderr, "hand_over: %s\n", error.what());
    return 1;
  }
}
