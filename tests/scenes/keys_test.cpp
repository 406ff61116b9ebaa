#include "simulator/scene/keys.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/check_accuracy.hpp"
#include "cli/scene_schema.hpp"
#include "files/atomic_file.hpp"
#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::simulator;

TEST_CASE("docs/scenes.md ends in the table of keys as it is") {
  const std::string text =
      files::read_text(std::filesystem::path(SHAKEBED_SOURCE_FOLDER) / "docs" / "scenes.md");
  const std::size_t begin = text.find("| key |");
  REQUIRE(begin != std::string::npos);
  CHECK(text.substr(begin) == scene_keys_markdown());
}

TEST_CASE("The example of docs/scenes.md is the scene that it names") {
  const std::filesystem::path root(SHAKEBED_SOURCE_FOLDER);
  const std::string text = files::read_text(root / "docs" / "scenes.md");
  const std::size_t begin = text.find("```yaml\n") + 8;
  const std::string example = text.substr(begin, text.find("```", begin) - begin);
  CHECK(canonical_yaml(tests::scene_of(example)) ==
        canonical_yaml(read_scene(root / "scenes" / "rough_3d.yaml")));
}

TEST_CASE("No key stands twice in the table, and every one says what it is") {
  std::set<std::string_view> paths;
  for (const Key& key : scene_keys()) {
    CAPTURE(key.path);
    CHECK(paths.insert(key.path).second);
    CHECK_FALSE(key.doc.empty());
    CHECK((key.type == KeyType::word) ==
          (type_text(key).find("number") == std::string::npos && !key.words.empty()));
    CHECK(key.doc.find('|') == std::string_view::npos);
  }
}

TEST_CASE("Every key of the table is checked for its type and its range") {
  for (const Key& key : scene_keys()) {
    CAPTURE(key.path);
    const std::string path(key.path);
    // `scene` is not overridden: its faults hide all others.
    if (path == "scene") continue;
    const auto complaint = [&](const std::string& value) {
      const auto faults = tests::faults_of(tests::rough_bed, {{path, value}});
      return std::any_of(faults.begin(), faults.end(), [&](const files::Fault& fault) {
        return fault.where == "--set " + path + "=" + value &&
               fault.what.find("`" + path) != std::string::npos;
      });
    };
    CHECK(complaint("[[]]"));
    CHECK(complaint("no such value"));
    if (std::isfinite(key.range.low)) {
      const std::string unit = key.type == KeyType::percent    ? " %"
                               : key.type == KeyType::quantity ? " " + std::string(key.unit)
                                                               : "";
      const std::string low = "-1" + unit;
      CHECK(complaint(key.type == KeyType::numbers ? "[" + low + "]" : low));
    }
  }
}

TEST_CASE("The JSON schema holds every key with its range") {
  const auto schema = nlohmann::json::parse(cli::scene_json_schema());
  CHECK(schema["required"] == nlohmann::json({"scene", "dimension"}));
  CHECK(schema["additionalProperties"] == false);
  CHECK(schema["properties"]["seed"]["type"] == "integer");
  CHECK(schema["properties"]["grains"]["properties"]["restitution"]["exclusiveMinimum"] == 0);
  CHECK(schema["properties"]["grains"]["properties"]["restitution"]["maximum"] == 1);
  const auto tangential = schema["properties"]["contact"]["properties"]["tangential"]["anyOf"];
  CHECK(tangential[0]["enum"] == nlohmann::json({"frictionless"}));
  CHECK(tangential[1]["properties"]["law"]["enum"] ==
        nlohmann::json({"viscous_coulomb", "cundall_strack", "frictionless"}));

  for (const Key& key : scene_keys()) {
    CAPTURE(key.path);
    const nlohmann::json* node = &schema;
    std::string_view rest = key.path;
    while (!rest.empty() && node != nullptr) {
      const std::string name(rest.substr(0, rest.find('.')));
      rest = rest.size() > name.size() ? rest.substr(name.size() + 1) : "";
      if (node->contains("anyOf")) node = &(*node)["anyOf"].back();
      REQUIRE(node->contains("properties"));
      REQUIRE((*node)["properties"].contains(name));
      node = &(*node)["properties"][name];
    }
  }
}

TEST_CASE("docs/accuracy.md has the table of promises as it is") {
  const auto text = files::read_text(std::string(SHAKEBED_SOURCE_FOLDER) + "/docs/accuracy.md");
  CHECK(text.find(cli::accuracy_markdown()) != std::string::npos);
}

}  // namespace
