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
};

/// Reads and checks a scene (schema 1). All faults are collected in one pass and thrown as one
/// files::Error(bad_input) with file:line:column each.
///
/// Overrides are applied before checking. Setting one of several equivalent keys replaces the
/// others: a drive rate (W, Gamma, frequency, angular_frequency, frequency_rpm) replaces the other
/// rate beside an amplitude; grains.layers and grains.count replace each other, and so do
/// measure.cycles and measure.until.
Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {});
Scene read_scene(const files::YamlNode& root, const std::vector<Override>& overrides = {});

/// The scene as understood, every value written out in reduced units, keys in a fixed order,
/// numbers in shortest round-trip form: equal scenes give equal bytes. It reads back as itself.
/// The seed is part of it.
std::string canonical_yaml(const Scene& scene);

}  // namespace shakebed::simulator
