#pragma once

#include <string>
#include <vector>

#include "simulator/scene/read_scene.hpp"

namespace shakebed::tests {

/// A small bed after Sun 2006, table I.
inline simulator::Scene small_column(const std::vector<simulator::Override>& overrides = {}) {
  const auto root = files::YamlNode::load_text(R"(scene: 1
dimension: 3
container: {cylinder: {diameter: 5}, wall: {gamma_t: 20}}
grains: {count: 60, friction: 0.5, large: {diameter: 2, density: 13.54}}
base: {drive: {frequency: 0.3, amplitude: 1}}
contact: {stiffness: 2e5, gamma_n: 40, tangential: {law: cundall_strack}}
protocol: {time_step: {value: 2e-4}, measure: {cycles: 2}}
)",
                                               "s.yaml");
  return simulator::read_scene(root, overrides);
}

}  // namespace shakebed::tests
