#include "files/csv.hpp"
#include "simulator/scene/column.hpp"

namespace shakebed::simulator {
namespace {

using files::number_text;

std::string grains_text(const Scene& scene) {
  const ColumnScene& column = *scene.column;
  std::string text = "grains:\n  count: " + std::to_string(scene.grains.count) + "\n";
  text += "  friction: " + number_text(column.grain.friction) + "\n";
  text += "  sizes: [" + number_text(column.smallest) + ", " + number_text(column.largest) + "]\n";
  if (column.has_large) {
    text += "  large:\n    diameter: " + number_text(column.large_diameter) +
            "\n    density_ratio: " + number_text(column.large_density) + "\n";
  }
  return text;
}

std::string container_text(const ColumnScene& column, bool with_frame) {
  const SpringKind& wall = column.wall;
  std::string text =
      "container:\n  cylinder:\n    diameter: " + number_text(column.diameter) + "\n";
  if (with_frame) {
    text += std::string("  frame: ") + (column.frame == ContainerFrame::lab ? "lab" : "co_moving") +
            "\n";
  }
  text += "  wall:\n    friction: " + number_text(wall.friction);
  text += "\n    stiffness: " + number_text(wall.normal_stiffness);
  text += "\n    stiffness_ratio: " + number_text(column.wall_stiffness_ratio);
  text += "\n    gamma_n: " + number_text(wall.normal_rate);
  text += "\n    gamma_t: " + number_text(wall.tangential_rate) + "\n";
  return text;
}

std::string contact_text(const ColumnScene& column) {
  const SpringKind& grain = column.grain;
  const bool hertz = column.overlap_law == OverlapLaw::hertz;
  std::string text =
      std::string("contact:\n  normal: ") + (hertz ? "hertz" : "linear_spring_dashpot") + "\n";
  text += "  stiffness: " + number_text(grain.normal_stiffness);
  text += "\n  gamma_n: " + number_text(grain.normal_rate);
  text += "\n  tangential:\n    law: cundall_strack\n    stiffness_ratio: " +
          number_text(column.grain_stiffness_ratio);
  text += "\n    gamma_t: " + number_text(grain.tangential_rate) + "\n";
  return text;
}

std::string prepare_text(const ColumnScene& column) {
  return "  prepare:\n    frequency: " + number_text(column.prepare_frequency) +
         "\n    Gamma: " + number_text(column.prepare_Gamma) +
         "\n    kinetic_energy: " + number_text(column.prepare_kinetic_energy) + "\n";
}

std::string time_step_text(const Scene& scene) {
  std::string text = "  time_step:\n";
  if (scene.column->time_step) {
    text += "    value: " + number_text(*scene.column->time_step) + "\n";
  } else {
    text += "    fraction_of_contact_duration: " + number_text(scene.protocol.time_step_fraction) +
            "\n";
  }
  if (scene.protocol.allow_coarse_time_step) text += "    allow_coarse: true\n";
  text += std::string("  contact_velocities: ") +
          (scene.column->predict_velocities ? "predicted" : "half_step") + "\n";
  return text;
}

std::string snapshots_text(const Scene& scene) {
  const auto& snapshots = scene.protocol.snapshots;
  if (snapshots.phases.empty()) {
    // Without the key a run this long would have the default's snapshots.
    const bool off = scene.protocol.cycles.value_or(0) > default_snapshot_cycle;
    return off ? "  snapshots: {phases: []}\n" : "";
  }
  std::string phases;
  for (const double phase : snapshots.phases) {
    phases += (phases.empty() ? "" : ", ") + number_text(phase);
  }
  return "  snapshots:\n    phases: [" + phases +
         "]\n    from_cycle: " + std::to_string(snapshots.from_cycle) +
         "\n    cycles: " + std::to_string(snapshots.cycles) + "\n";
}

}  // namespace

std::string canonical_column_yaml(const Scene& scene) {
  const ColumnScene& column = *scene.column;
  std::string text = "scene: 1\ndimension: 3\ngravity: 1\n" + grains_text(scene);
  text += container_text(column, true);
  text += "base:\n  drive:\n    amplitude: " + number_text(scene.base.drive.amplitude) +
          "\n    angular_frequency: " + number_text(scene.base.drive.angular_frequency) + "\n";
  text += contact_text(column);
  text += "drag:\n  background: " + number_text(column.background_damping) +
          "\n  air: " + number_text(column.air_damping) +
          "\n  air_packing_fraction: " + number_text(column.air_packing_fraction) + "\n";
  text += "protocol:\n" + prepare_text(column);
  text += "  measure:\n    cycles: " + std::to_string(scene.protocol.cycles.value_or(1)) + "\n";
  text += time_step_text(scene);
  if (column.list_skin != ColumnScene().list_skin) {
    text += "  list_skin: " + number_text(column.list_skin) + "\n";
  }
  text += std::string("  engine: ") +
          (scene.protocol.engine == Engine::uniform ? "uniform" : "auto") + "\n";
  text += snapshots_text(scene);
  text += "seed: " + std::to_string(scene.seed) + "\n";
  return text;
}

std::string preparation_text(const Scene& scene) {
  const ColumnScene& column = *scene.column;
  return grains_text(scene) + container_text(column, false) + contact_text(column) + "protocol:\n" +
         prepare_text(column) + "seed: " + std::to_string(scene.seed) + "\n";
}

std::string pouring_text(const Scene& scene) {
  // Parameters that no contact without friction has.
  Scene slick = scene;
  auto& column = *slick.column;
  column.grain.friction = column.wall.friction = 0;
  column.grain.tangential_rate = column.wall.tangential_rate = 0;
  column.grain_stiffness_ratio = column.wall_stiffness_ratio = 0;
  return preparation_text(slick);
}

}  // namespace shakebed::simulator
