// Time per grain and step and bytes per grain of every composition of the plain stepper and of the
// stepper of containers: what a scene does not ask for it should not pay for. All compositions are
// run once before any is run again; the least time counts.
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"

namespace {

using namespace shakebed::simulator;

struct Composition {
  std::string name;
  std::string scene;
  std::vector<Override> overrides;
  std::vector<Override> larger;  ///< four times the grains; else memory is not asked for
  double nanoseconds = INFINITY;
  double bytes = std::nan("");
};

const std::vector<Override> smooth{
    {"contact.tangential", "frictionless"}, {"grains.friction", "0"}, {"base.friction", "0"}};

std::vector<Override> operator+(std::vector<Override> a, const std::vector<Override>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Composition> compositions() {
  const std::string bed = SHAKEBED_ROUGH_BED;
  const std::string column = SHAKEBED_COLUMN;
  const std::vector<Override> flat{{"dimension", "2"}, {"cell", "[25]"}, {"grains.count", "100"}};
  const std::vector<Override> flat_large{
      {"dimension", "2"}, {"cell", "[100]"}, {"grains.count", "400"}};
  const std::vector<Override> plain{{"protocol.engine", "uniform"},
                                    {"protocol.transient.cycles", "3"},
                                    {"protocol.measure.cycles", "10"}};
  const std::vector<Override> wide{{"cell", "[10, 10]"}};
  const std::vector<Override> lid{{"lid.height", "40"}};
  const std::vector<Override> small{{"grains.count", "300"},
                                    {"container.cylinder.diameter", "7"},
                                    {"protocol.measure.cycles", "3"},
                                    {"protocol.snapshots.phases", "[]"}};
  const std::vector<Override> slick{{"contact.tangential", "frictionless"},
                                    {"grains.friction", "0"},
                                    {"container.wall.friction", "0"}};
  return {{"2D frictionless periodic", bed, plain + flat + smooth, plain + flat_large + smooth},
          {"2D viscous-Coulomb periodic", bed, plain + flat, plain + flat_large},
          {"3D frictionless periodic", bed, plain + smooth, plain + smooth + wide},
          {"3D viscous-Coulomb periodic", bed, plain, plain + wide},
          {"3D frictionless lid", bed, plain + smooth + lid, plain + smooth + lid + wide},
          {"3D viscous-Coulomb lid", bed, plain + lid, plain + lid + wide},
          {"3D frictionless cylinder linear", column, small + slick, {}},
          {"3D spring with history cylinder linear", column, small, {}},
          {"3D spring with history cylinder Hertz",
           column,
           small + std::vector<Override>{{"contact.normal", "hertz"}},
           {}},
          {"3D spring with history cylinder linear polydisperse",
           column,
           small + std::vector<Override>{{"grains.sizes", "[0.8, 1.2]"}},
           {}}};
}

/// Heap in use, with what malloc got as mappings of its own.
double heap() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

struct Run {
  double nanoseconds;  ///< per grain and step
  double bytes;        ///< heap while it runs
  double grains;
};

double scalar(const Record& record, const std::string& name) {
  for (const auto& one : record.scalars) {
    if (one.name == name) return one.value;
  }
  return std::nan("");
}

/// Timed from the first cycle's beginning to the last one's, so that settling does not count.
Run run(const std::string& file, const std::vector<Override>& overrides) {
  const Scene scene = read_scene(file, overrides);
  const double before = heap();
  double most = 0;
  std::vector<std::clock_t> begun;
  const auto at_cycle = [&](double) {
    most = std::max(most, heap() - before);
    begun.push_back(std::clock());
  };
  const auto record = simulate(scene, {{}, at_cycle, nullptr});
  const double grains = scalar(record, "grains");
  const double seconds = static_cast<double>(begun.back() - begun.front()) / CLOCKS_PER_SEC;
  const double steps = static_cast<double>(begun.size() - 1) * scalar(record, "steps_per_cycle");
  return {1e9 * seconds / (grains * steps), most, grains};
}

}  // namespace

int main() {
  auto all = compositions();
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    for (auto& one : all) {
      const Run small = run(one.scene, one.overrides);
      one.nanoseconds = std::min(one.nanoseconds, small.nanoseconds);
      if (round > 0 || one.larger.empty()) continue;
      const Run large = run(one.scene, one.larger);
      one.bytes = (large.bytes - small.bytes) / (large.grains - small.grains);
    }
  }
  std::printf("composition [],time_per_grain_step [ns],bytes_per_grain [B]\n");
  for (const auto& one : all) {
    std::printf("%s,%.3g,", one.name.c_str(), one.nanoseconds);
    if (std::isfinite(one.bytes)) std::printf("%.0f", one.bytes);
    std::printf("\n");
  }
}
