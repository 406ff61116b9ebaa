#include "cli/scene_schema.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "simulator/scene/keys.hpp"

namespace shakebed::cli {

namespace {

using simulator::Key;
using simulator::KeyType;
using Json = nlohmann::ordered_json;

Json bounded(Json schema, const simulator::Range& range) {
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) {
    schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  }
  return schema;
}

Json value_schema(const Key& key) {
  switch (key.type) {
    case KeyType::integer:
      return bounded({{"type", "integer"}}, key.range);
    case KeyType::number:
      return bounded({{"type", "number"}}, key.range);
    case KeyType::boolean:
      return {{"type", "boolean"}};
    case KeyType::numbers:
      return {{"type", "array"}, {"items", bounded({{"type", "number"}}, key.range)}};
    case KeyType::percent:
      return {{"type", "string"}, {"pattern", "^[0-9.eE+-]+ *%$"}};
    case KeyType::quantity: {
      std::string units;
      for (const auto& size : simulator::unit_sizes()) {
        if (size.kind == key.unit) units += (units.empty() ? "" : "|") + std::string(size.name);
      }
      return {{"type", "string"}, {"pattern", "^[0-9.eE+-]+ *(" + units + ")$"}};
    }
    case KeyType::word:
      break;
  }
  return nullptr;
}

/// What may stand at the key itself: its value, or one of its words.
Json leaf_schema(const Key& key) {
  Json value = value_schema(key);
  Json schema;
  if (key.words.empty()) {
    schema = value;
  } else {
    Json words = {{"enum", key.words}};
    schema = value.is_null() ? words : Json{{"anyOf", Json::array({value, words})}};
  }
  std::string text(key.doc);
  if (!key.unit.empty() && key.unit != "1") text += " [" + std::string(key.unit) + "]";
  if (!key.fallback.empty()) text += "; default: " + std::string(key.fallback);
  schema["description"] = text;
  return schema;
}

bool holds_required_key(const std::string& path) {
  const auto& keys = simulator::scene_keys();
  return std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
    return key.required && (key.path == path || key.path.starts_with(path + "."));
  });
}

Json node_schema(const std::string& path) {
  Json map = {{"type", "object"}, {"additionalProperties", false}};
  Json required = Json::array();
  const auto below = simulator::scene_keys_under(path);
  for (const auto& name : below) {
    const std::string child = path.empty() ? name : path + "." + name;
    map["properties"][name] = node_schema(child);
    if (holds_required_key(child)) required.push_back(name);
  }
  if (!required.empty()) map["required"] = required;
  const Key* key = simulator::find_scene_key(path);
  if (key == nullptr) return map;
  if (below.empty()) return leaf_schema(*key);
  return {{"anyOf", Json::array({leaf_schema(*key), map})}};
}

}  // namespace

std::string scene_json_schema() {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "shakebed scene, schema 1"}};
  schema.update(node_schema(""));
  return schema.dump(2) + "\n";
}

}  // namespace shakebed::cli
