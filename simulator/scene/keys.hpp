#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace shakebed::simulator {

enum class KeyType {
  integer,
  number,
  boolean,
  word,     ///< one of `Key::words`
  numbers,  ///< a list of numbers
  percent,  ///< "1 %"
  quantity  ///< a number and a unit of `Key::unit`'s kind: "5 mm"
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< the lower end itself is refused
  bool high_open = false;  ///< the upper end itself is refused

  bool contains(double value) const;
  bool bounded() const;
  std::string text() const;  ///< "(0, 1]", ">= 0"; empty when unbounded
};

/// One key of a scene. The reader's checks, `shakebed check --keys`, docs/scenes.md and the JSON
/// schema are all made from the table of these.
struct Key {
  std::string_view path;  ///< "base.drive.W"
  KeyType type;
  std::string_view unit;  ///< "d", "sqrt(d/g)", "1"; empty for words
  Range range;
  std::vector<std::string_view> words;  ///< words allowed, also in place of a number
  bool required;
  std::string_view fallback;  ///< the default in words, or which keys stand in for this one
  std::string_view doc;
};

const std::vector<Key>& scene_keys();

/// The row of a path, or null.
const Key* find_scene_key(std::string_view path);

/// The names directly under a path of the table: {"restitution", ...} under "grains".
std::vector<std::string> scene_keys_under(std::string_view path);

/// "number or auto", "list of numbers", "percentage such as 1 %".
std::string type_text(const Key& key);

/// A unit's size: the factor by which a quantity in it is divided to come to the key's unit.
struct UnitSize {
  std::string_view name;
  std::string_view kind;  ///< the unit of the table it converts to: "mm", "kg/m3", "m/s2"
  double per_kind;
};
const std::vector<UnitSize>& unit_sizes();

/// The table as Markdown, as in docs/scenes.md.
std::string scene_keys_markdown();

}  // namespace shakebed::simulator
