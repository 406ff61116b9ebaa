#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "files/error.hpp"
#include "simulator/record_lookup.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"

// CPU time per collision of the event engine as the bed grows at W = 22.36: wider, four layers
// deep, from 50 to 5000 grains; and deeper, in the cell of 5 x 5 d, from 1 to 16 layers. Bhateja's
// rough grains. Contacts stay short in all of them (50 to 66 steps), so that a collision which
// costs more does so for the grains that are stepped along with it. CSV on standard output;
// growth.gp draws it.
namespace {

using namespace shakebed;

bool deep_bed(long grains, double width) {
  return static_cast<double>(grains) > 10 * width * width;
}

void measure(const char* series, long grains, double width) {
  using files::number_text;
  // Enough cycles for some 1e5 collisions; fewer of the deepest bed, whose cycles are dear.
  const long cycles = 4 + (deep_bed(grains, width) ? 4000 : 40000) / grains;
  const std::vector<simulator::Override> overrides = {
      {"grains.count", std::to_string(grains)},
      {"cell", "[" + number_text(width) + ", " + number_text(width) + "]"},
      {"protocol.settle", "20"},
      {"protocol.transient.cycles", "10"},
      {"protocol.measure.cycles", std::to_string(cycles)}};
  const auto record = simulator::simulate(simulator::read_scene(SHAKEBED_ROUGH_BED, overrides));
  const double collisions = scalar_of(record, "collisions");
  const double seconds = record.timing.cpu_seconds_measuring;
  std::printf("%s,%ld,%.4g,%.4g,%.4g,%.4g,%.4g\n", series, grains,
              static_cast<double>(grains) / (width * width),
              collisions / static_cast<double>(cycles),
              1000 * seconds / static_cast<double>(cycles), 1e6 * seconds / collisions,
              scalar_of(record, "contact_steps") / collisions);
  std::fflush(stdout);
}

}  // namespace

int main() {
  try {
    std::printf(
        "series,grains,grains per d^2,collisions per cycle,ms per cycle,us per collision,"
        "steps per collision\n");
    for (const long grains : {50L, 100L, 200L, 400L, 1000L, 2500L, 5000L}) {
      measure("wider", grains, std::sqrt(static_cast<double>(grains) / 4));
    }
    for (const long layers : {1L, 2L, 4L, 8L, 16L}) measure("deeper", 25 * layers, 5);
    return 0;
  } catch (const files::Error& error) {
    std::fprintf(stderr, "growth: %s\n", error.what());
    return 1;
  }
}
