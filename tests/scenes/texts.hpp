#pragma once

#include <string>
#include <vector>

#include "files/error.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::tests {

/// The standard rough bed, one key a line so that places are easy to count.
inline const std::string rough_bed =
    "scene: 1\n"                                 // line 1
    "dimension: 3\n"                             // 2
    "grains: {layers: 4, restitution: 0.9}\n"    // 3
    "cell: [5, 5]\n"                             // 4
    "base: {drive: {W: 22.36, amplitude: 1}}\n"  // 5
    "protocol: {measure: {cycles: 300}}\n";      // 6

inline simulator::Scene scene_of(const std::string& text,
                                 const std::vector<simulator::Override>& overrides = {}) {
  return simulator::read_scene(files::YamlNode::load_text(text, "s.yaml"), overrides);
}

/// The standard bed with some of its keys replaced or added.
inline simulator::Scene bed_with(const std::vector<simulator::Override>& overrides) {
  return scene_of(rough_bed, overrides);
}

/// What reading complains about; empty when it does not.
inline std::vector<files::Fault> faults_of(const std::string& text,
                                           const std::vector<simulator::Override>& overrides = {}) {
  try {
    scene_of(text, overrides);
  } catch (const files::Error& error) {
    return error.faults();
  }
  return {};
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the text has no `" + from + "`");
  return text.replace(at, from.size(), to);
}

}  // namespace shakebed::tests
