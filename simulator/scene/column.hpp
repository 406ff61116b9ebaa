#pragma once

#include <optional>
#include <string>

#include "simulator/scene/scene.hpp"
#include "simulator/scene/values.hpp"

namespace shakebed::simulator {

/// The cycle in which a bed in a container has snapshots when nothing else is said.
constexpr long default_snapshot_cycle = 10;

/// Completes a scene that has a container; what does not fit goes to the faults of `values`. Called
/// once grains.count, grains.friction, the drive and the protocol's measured cycles are known.
void read_column(SceneValues& values, Scene& scene, std::optional<double> diameter_mm);

/// Reports keys that mean something only in a container, and there is none.
void refuse_column_keys(SceneValues& values);

/// The same bed as YAML that reads back as itself.
std::string canonical_column_yaml(const Scene& scene);

/// What a prepared bed depends on: scenes that give the same text may share it.
std::string preparation_text(const Scene& scene);

/// What its packing depends on, up to the instant when friction begins: the same for scenes that
/// differ in friction, k_t/k_n or gamma_t.
std::string pouring_text(const Scene& scene);

}  // namespace shakebed::simulator
