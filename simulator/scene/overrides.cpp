#include <algorithm>
#include <array>

#include "simulator/scene/keys.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::simulator {

namespace {

using files::YamlNode;
using Paths = std::vector<std::string>;

const std::string drive = "base.drive";
const std::string until = "protocol.measure.until";

/// Keys that a newly set one replaces, outside the drive.
Paths replaced_by(std::string_view path) {
  static const std::array<std::pair<std::string, std::string>, 3> pairs{{
      {"grains.layers", "grains.count"},
      {"cell", "cell_mm"},
      {"units.diameter", "grains.diameter_mm"},
  }};
  for (const auto& [one, other] : pairs) {
    if (path == one) return {other};
    if (path == other) return {one};
  }
  if (path == "accuracy" || path.starts_with("accuracy.")) {
    return {"protocol.measure.cycles", until, "protocol.time_step", "protocol.engine",
            "protocol.contacts"};
  }
  if (path == "protocol.measure.cycles") return {until, "protocol.measure.at_most", "accuracy"};
  if (path == until) return {"protocol.measure.cycles", "accuracy"};
  if (path.starts_with("protocol.time_step")) return {"accuracy"};
  if (path.starts_with(until + ".")) {
    Paths others{"protocol.measure.cycles", "accuracy"};
    for (const auto& name : scene_keys_under(until)) {
      if (path != until + "." + name) others.push_back(until + "." + name);
    }
    return others;
  }
  return {};
}

bool is_amplitude(std::string_view name) { return name.starts_with("amplitude"); }

/// What a drive key tells: its amplitude, its frequency, W or Gamma.
std::string_view told_by(std::string_view name) {
  if (is_amplitude(name)) return "amplitude";
  if (name == "W" || name == "Gamma") return name;
  return "frequency";
}

/// Drops the drive keys of the scene that those set explicitly stand in for.
YamlNode without_replaced_drive_keys(YamlNode root, const Paths& set) {
  const auto base = root.find("base");
  const auto node = base ? base->find("drive") : std::nullopt;
  if (set.empty() || !node || !node->is_map()) return root;
  Paths kept;
  for (const auto& [name, value] : node->items()) {
    if (std::find(set.begin(), set.end(), name) == set.end()) kept.push_back(name);
  }
  const auto drop_if = [&](auto&& replaced) {
    for (const auto& name : kept) {
      if (replaced(name)) root = root.without(drive + "." + name);
    }
    std::erase_if(kept, replaced);
  };
  if (set.size() > 1) {
    drop_if([](const std::string&) { return true; });
    return root;
  }
  drop_if([&](const std::string& name) { return told_by(name) == told_by(set.front()); });
  const bool amplitude_kept = std::any_of(kept.begin(), kept.end(), is_amplitude);
  // Beside two rates it would be a guess which one to replace: the reader refuses all three.
  if (!is_amplitude(set.front()) && amplitude_kept) {
    drop_if([](const std::string& name) { return !is_amplitude(name); });
  }
  return root;
}

}  // namespace

YamlNode with_overrides(YamlNode root, const std::vector<Override>& overrides) {
  Paths drive_keys_set;
  for (const auto& [path, value, origin] : overrides) {
    root = root.with(path, value, origin.empty() ? "--set " + path + "=" + value : origin);
    for (const auto& replaced : replaced_by(path)) root = root.without(replaced);
    if (path == "base" || path == drive) {
      drive_keys_set.clear();
    } else if (path.starts_with(drive + ".")) {
      const std::string name = path.substr(drive.size() + 1);
      if (std::find(drive_keys_set.begin(), drive_keys_set.end(), name) == drive_keys_set.end()) {
        drive_keys_set.push_back(name);
      }
    }
  }
  return without_replaced_drive_keys(std::move(root), drive_keys_set);
}

}  // namespace shakebed::simulator
