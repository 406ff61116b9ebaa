#pragma once

#include <cmath>
#include <filesystem>
#include <string>

#include "files/atomic_file.hpp"
#include "simulator/record.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate.hpp"
#include "sweeps/grid.hpp"
#include "tests/store/example_record.hpp"

namespace shakebed::tests {

/// A folder with a scene to sweep over.
class SmallSweep {
 public:
  SmallSweep() {
    files::write_text(folder.path() / "scene.yaml",
                      "scene: 1\n"
                      "units: {diameter: 5 mm, gravity: 9.81 m/s2}\n"
                      "dimension: 2\n"
                      "grains: {layers: 2, restitution: 0.9}\n"
                      "cell: [5]\n"
                      "base: {drive: {W: 9, amplitude: 1}}\n"
                      "contact: {normal: linear_spring_dashpot}\n"
                      "protocol: {measure: {cycles: 10}}\n"
                      "seed: 1\n");
  }

  std::filesystem::path write(const std::string& body) const {
    const auto file = folder.path() / "sweep.yaml";
    files::write_text(file, "sweep: 1\nid: small\nbase: scene.yaml\n" + body);
    return file;
  }

  sweeps::Grid grid(const std::string& body, const std::string& profile = "quick") const {
    return sweeps::read_grid(write(body), profile);
  }

  TemporaryFolder folder;
};

inline constexpr double pretended_cpu_seconds = 1.5;

/// What a bed would leave, as a function of its scene alone.
inline simulator::Record pretended_record(const simulator::Scene& scene) {
  simulator::Record record;
  record.physics_version = simulator::physics_version;
  record.seed = scene.seed;
  record.timing.cpu_seconds = pretended_cpu_seconds;
  record.dimension = scene.dimension;
  record.canonical_scene = simulator::canonical_yaml(scene);
  const double noise = std::sin(static_cast<double>(scene.seed % 1000));
  record.quantities = {{"T_z", "m g d", {scene.W() + 0.01 * noise, 0.01}},
                       {"h_cm", "d", {2 + 0.01 * noise, 0.01}}};
  record.scalars = {{"cycles", "1", 10},
                    {"k_n", "m g/d", 1e5},
                    {"largest_overlap", "d", 0.1 * std::abs(noise)},
                    {"collisions", "1", 100},
                    {"W", "1", scene.W()}};
  record.series = {{"T_z", "m g d", 2, {1, 2, 3, 4, 5}}};
  record.stationary = true;
  return record;
}

}  // namespace shakebed::tests
