#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <future>
#include <string>
#include <vector>

#include "simulator/observables/correlation.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "tests/oracle/lammps.hpp"

// Beds of ours, by the engine that a scene gets unasked, against the same beds in LAMMPS. T_z, T_x
// and h_cm of three scenes: nine comparisons at three combined standard errors. A Gaussian
// difference alarms falsely in 0.27 % of comparisons; LAMMPS' own bias of about -0.5 % of T_z at
// t_c/75 is within one standard error and raises that to about 1.2 % where T_z is concerned, so
// that one of the nine is falsely off in about 5 % of all choices of seeds. The seeds are fixed: on
// one machine the verdict repeats.
namespace {

using namespace shakebed;
using simulator::Estimate;

constexpr double margin = 3;            // combined standard errors
constexpr double largest_error = 0.01;  // combined standard error of T_z over T_z: the power

Estimate mean_of(const std::vector<Estimate>& replicates) {
  Estimate all{0, 0};
  const auto n = static_cast<double>(replicates.size());
  for (const auto& one : replicates) {
    all.mean += one.mean / n;
    all.standard_error = std::hypot(all.standard_error, one.standard_error / n);
  }
  return all;
}

Estimate quantity_of(const simulator::Record& record, const std::string& name) {
  for (const auto& quantity : record.quantities) {
    if (quantity.name == name) return quantity.estimate;
  }
  FAIL("no quantity " << name);
  return {};
}

struct Comparison {
  std::string file;                   ///< a scene of scenes/
  std::vector<std::string> settings;  ///< "base.drive.W=5.6"
  long lammps_cycles;                 ///< for each seed
};

simulator::Scene scene_of(const Comparison& comparison) {
  std::vector<simulator::Override> overrides;
  for (const auto& setting : comparison.settings) {
    const auto equals = setting.find('=');
    overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
  }
  const std::string folder = SHAKEBED_SCENES;
  return simulator::read_scene(folder + "/" + comparison.file, overrides);
}

void compare(const Comparison& comparison) {
  if (!tests::lammps_is_here()) {
    WARN(
        "oracle skipped: no program lmp with the package GRANULAR on PATH "
        "(make deps-oracle installs it)");
    return;
  }
  auto scene = scene_of(comparison);
  scene.protocol.until.reset();

  scene.protocol.cycles = comparison.lammps_cycles;
  std::vector<std::future<tests::CycleAverages>> running;
  for (const std::uint64_t seed : {101, 102}) {
    running.push_back(
        std::async(std::launch::async, [scene, seed] { return tests::run_lammps(scene, seed); }));
  }
  std::vector<tests::CycleAverages> theirs;
  for (auto& one : running) theirs.push_back(one.get());

  scene.protocol.cycles = 2 * comparison.lammps_cycles;  // ours are the cheaper ones
  std::vector<simulator::Record> ours;
  for (const std::uint64_t seed : {1, 2}) {
    scene.seed = seed;
    ours.push_back(simulator::simulate(scene));
    CHECK(ours.back().stationary);
  }

  for (const std::string name : {"T_z", "T_x", "h_cm"}) {
    std::vector<Estimate> our_seeds;
    std::vector<Estimate> their_seeds;
    for (const auto& record : ours) our_seeds.push_back(quantity_of(record, name));
    for (const auto& averages : theirs) {
      their_seeds.push_back(simulator::mean_of_series(averages.at(name)).estimate);
    }
    const Estimate a = mean_of(our_seeds);
    const Estimate b = mean_of(their_seeds);
    const double error = std::hypot(a.standard_error, b.standard_error);
    const double difference = (a.mean - b.mean) / error;
    std::printf("%-5s shakebed %.6g +- %.2g  LAMMPS %.6g +- %.2g  difference %+.2f %% = %+.2f se\n",
                name.c_str(), a.mean, a.standard_error, b.mean, b.standard_error,
                100 * (a.mean / b.mean - 1), difference);
    INFO(name << ": shakebed " << a.mean << " +- " << a.standard_error << ", LAMMPS " << b.mean
              << " +- " << b.standard_error);
    CHECK(std::abs(difference) <= margin);
    if (name == "T_z") CHECK(error <= largest_error * a.mean);
  }
}

}  // namespace

TEST_CASE("LAMMPS agrees: three dimensions, rough", "[rough_3d]") {
  compare({"rough_3d.yaml", {"contact.stiffness=1e5"}, 400});
}

TEST_CASE("LAMMPS agrees: two dimensions, smooth", "[smooth_2d]") {
  compare({"smooth_2d.yaml", {"base.drive.W=5.6", "contact.stiffness=2e4"}, 700});
}

// Every parameter that pair and base may have of their own differs, and c_t is not c_n.
TEST_CASE("LAMMPS agrees: a base unlike the grains", "[unlike_base]") {
  compare({"rough_3d.yaml",
           {"cell=[4, 6]", "grains.layers=3", "grains.restitution=0.95", "grains.friction=0.6",
            "base.restitution=0.7", "base.friction=0.1", "base.drive.W=10", "contact.stiffness=5e4",
            "contact.tangential.damping=critical"},
           450});
}
