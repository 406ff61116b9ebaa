#include "simulator/scene/values.hpp"

#include <algorithm>

#include "files/csv.hpp"

namespace shakebed::simulator {

namespace {

using files::YamlNode;

std::string shown(const YamlNode& node) {
  switch (node.kind()) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::map:
      return "a map";
    case YamlNode::Kind::sequence:
      return "a list";
    case YamlNode::Kind::scalar:
      break;
  }
  return "`" + node.as_string() + "`";
}

files::Error expected(const YamlNode& node, const std::string& what) {
  return node.error("expected " + what + ", got " + shown(node));
}

double in_range(const Key& key, double value, const YamlNode& node) {
  if (key.range.contains(value)) return value + 0.0;  // -0 becomes 0: equal scenes, equal bytes
  std::string what = "expected a value ";
  const std::string range = key.range.text();
  what += (range.starts_with('(') || range.starts_with('[') ? "in " : "") + range;
  if (!key.unit.empty() && key.unit != "1") what += " " + std::string(key.unit);
  throw node.error(what + ", got " + shown(node) + " (" + std::string(key.doc) + ")");
}

/// "5 mm" -> 5 and "mm".
std::pair<std::optional<double>, std::string> number_and_unit(const YamlNode& node) {
  const std::string text = node.is_scalar() ? node.as_string() : "";
  const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
  const std::size_t unit = std::min(text.find_first_not_of(' ', end), text.size());
  return {files::number_from_text(text.substr(0, end)), text.substr(unit)};
}

double percentage(const Key& key, const YamlNode& node) {
  const auto share = files::share_from_percent_text(node.is_scalar() ? node.as_string() : "");
  if (!share) throw expected(node, "a percentage such as `1 %`");
  in_range(key, 100 * *share, node);
  return *share;
}

double quantity(const Key& key, const YamlNode& node) {
  const auto [value, unit] = number_and_unit(node);
  std::string known;
  for (const UnitSize& size : unit_sizes()) {
    if (size.kind != key.unit) continue;
    if (value && size.name == unit) return in_range(key, *value / size.per_kind, node);
    known += (known.empty() ? "" : ", ") + std::string(size.name);
  }
  throw expected(node, "a number with one of the units " + known);
}

std::vector<double> list(const Key& key, const YamlNode& node) {
  if (!node.is_sequence()) throw expected(node, "a list such as [5, 5]");
  std::vector<double> values;
  std::vector<files::Fault> faults;
  for (const auto& element : node.elements()) {
    try {
      values.push_back(in_range(key, element.as_double(), element));
    } catch (const files::Error& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  if (!faults.empty()) throw files::Error(files::Error::Kind::bad_input, std::move(faults));
  return values;
}

/// The number of the table's type, or a word allowed in its place.
template <class Value, class Read>
Value number_or_word(const Key& key, const YamlNode& node, Read read) {
  if (node.is_scalar()) {
    const std::string text = node.as_string();
    if (std::find(key.words.begin(), key.words.end(), text) != key.words.end()) return text;
    const bool number_like = files::number_from_text(text).has_value();
    if (!key.words.empty() && !number_like) {
      const std::vector<std::string> words(key.words.begin(), key.words.end());
      const auto near = files::nearest_word(text, words);
      throw node.error("expected " + type_text(key) + ", got `" + text + "`" +
                       (near ? "; did you mean `" + *near + "`?" : ""));
    }
  }
  return read();
}

}  // namespace

SceneValues::SceneValues(const YamlNode& root, std::vector<files::Fault>& faults)
    : faults_(faults) {
  places_[""] = root.where();
  if (!root.is_map()) {
    report("", "expected a scene, a map that starts with `scene: 1`, got " + shown(root));
    return;
  }
  read_map(root, "");
  report_missing();
}

bool SceneValues::given(std::string_view path) const {
  if (places_.contains(path)) return true;
  const std::string below = std::string(path) + ".";
  const auto next = places_.lower_bound(below);
  return next != places_.end() && next->first.starts_with(below);
}

bool SceneValues::refused(std::string_view path) const {
  for (;;) {
    const auto value = values_.find(path);
    if (value != values_.end()) return std::holds_alternative<std::monostate>(value->second);
    const std::size_t dot = path.rfind('.');
    if (dot == std::string_view::npos) return false;
    path = path.substr(0, dot);
  }
}

std::string SceneValues::where(std::string_view path) const {
  for (;;) {
    if (const auto place = places_.find(path); place != places_.end()) return place->second;
    const std::size_t dot = path.rfind('.');
    path = dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
  }
}

void SceneValues::report(std::string_view path, const std::string& what) {
  faults_.push_back({where(path), what});
}

void SceneValues::read_map(const YamlNode& map, const std::string& prefix) {
  const auto known = scene_keys_under(prefix);
  for (const auto& [name, node] : map.items()) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      report_unknown(map, prefix, name);
      continue;
    }
    const std::string path = prefix.empty() ? name : prefix + "." + name;
    places_[path] = node.where();
    try {
      read_item(node, path);
    } catch (const files::Error& error) {
      values_[path] = std::monostate{};
      faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
    }
  }
}

void SceneValues::read_item(const YamlNode& node, const std::string& path) {
  const Key* key = find_scene_key(path);
  const auto below = scene_keys_under(path);
  if (!below.empty() && (node.is_map() || key == nullptr)) {
    if (!node.is_map()) {
      std::string names;
      for (const auto& name : below) names += (names.empty() ? "" : ", ") + name;
      throw expected(node, "a map with keys of: " + names);
    }
    read_map(node, path);
    return;
  }
  const auto number = [&] { return in_range(*key, node.as_double(), node); };
  const auto integer = [&] {
    const long value = node.as_integer();
    in_range(*key, static_cast<double>(value), node);
    return value;
  };
  const auto no_word = [&]() -> Value {
    throw expected(node, type_text(*key) + (below.empty() ? "" : " or a map"));
  };
  switch (key->type) {
    case KeyType::integer:
      values_[path] = number_or_word<Value>(*key, node, integer);
      break;
    case KeyType::number:
      values_[path] = number_or_word<Value>(*key, node, number);
      break;
    case KeyType::boolean:
      values_[path] = node.as_bool();
      break;
    case KeyType::word:
      values_[path] = number_or_word<Value>(*key, node, no_word);
      break;
    case KeyType::numbers:
      values_[path] = list(*key, node);
      break;
    case KeyType::percent:
      values_[path] = percentage(*key, node);
      break;
    case KeyType::quantity:
      values_[path] = quantity(*key, node);
      break;
  }
}

void SceneValues::report_unknown(const YamlNode& map, const std::string& prefix,
                                 const std::string& name) {
  std::string what = "unknown key `" + (prefix.empty() ? name : prefix + "." + name) + "`";
  const auto known = scene_keys_under(prefix);
  if (const auto near = files::nearest_word(name, known)) {
    what += "; did you mean `" + *near + "`?";
    // Then it is not missing as well.
    values_.try_emplace(prefix.empty() ? *near : prefix + "." + *near, std::monostate{});
  } else {
    const auto elsewhere =
        std::find_if(scene_keys().begin(), scene_keys().end(),
                     [&, &name = name](const Key& key) { return key.path.ends_with("." + name); });
    if (elsewhere != scene_keys().end()) {
      what += "; did you mean `" + std::string(elsewhere->path) + "`?";
    } else {
      what += "; known here:";
      for (const auto& one : known) what += " " + one;
    }
  }
  faults_.push_back({map.key_where(name), what});
}

void SceneValues::report_missing() {
  for (const Key& key : scene_keys()) {
    if (!key.required || given(key.path) || refused(key.path)) continue;
    report(key.path, "the key `" + std::string(key.path) + "` is missing (" + type_text(key) +
                         "): " + std::string(key.doc));
  }
}

}  // namespace shakebed::simulator
