#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/yaml.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// "base.drive.W=30": a key's path and its new YAML text.
struct Override {
  std::string path;
  std::string value;
  std::string origin = {};  ///< named in errors; empty: "--set base.drive.W=30"
};

/// Applies overrides in their order. A value below a word or below nothing makes the maps on its
/// way (protocol.transient.cycles=5 replaces `transient: auto`). Equivalent keys:
///  - grains.layers and grains.count, cell and cell_mm, units.diameter and grains.diameter_mm,
///    protocol.measure.cycles and protocol.measure.until with at_most, and the quantities of until
///    replace each other, the last one set wins;
///  - of base.drive, one key set replaces the scene's key that says the same: an amplitude the
///    other amplitude, a rate (W, Gamma, or a frequency) the rate that stands beside the amplitude;
///    two keys set replace both of the scene's, so that W and Gamma set together both count.
files::YamlNode with_overrides(files::YamlNode root, const std::vector<Override>& overrides);

/// Reads and checks a scene (schema 1), overrides applied first. All faults are collected in one
/// pass and thrown as one files::Error(bad_input) with file:line:column each.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {});
Scene read_scene(const files::YamlNode& root, const std::vector<Override>& overrides = {});

/// The scene as understood, every value written out in reduced units, keys in a fixed order,
/// numbers in shortest round-trip form: equal scenes give equal bytes. It reads back as itself.
/// The seed is part of it.
std::string canonical_yaml(const Scene& scene);

}  // namespace shakebed::simulator
