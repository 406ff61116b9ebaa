#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "files/yaml.hpp"
#include "simulator/scene/read_scene.hpp"
#include "sweeps/axis.hpp"

namespace shakebed::sweeps {

/// Keys of some points of the grid alone, an element of a profile's `points`:
///   {where: {N: [10, 15], frequency_rpm: [800, 900]}, set: {protocol.measure.at_most: 2000}}
/// A point is meant when each named column has one of the values listed, spelt as on its axis.
struct PointRule {
  struct Condition {
    std::size_t column;  ///< counted over all axes
    std::vector<std::string> labels;
  };
  std::vector<Condition> where;
  std::vector<simulator::Override> overrides;

  bool applies_to(const std::vector<std::string>& labels) const;
};

/// Refuses columns and values that no axis has.
std::vector<PointRule> read_point_rules(const files::YamlNode& list, const std::vector<Axis>& axes);

}  // namespace shakebed::sweeps
