#include "simulator/scene/read_scene.hpp"

#include "files/atomic_file.hpp"
#include "simulator/scene/admissible.hpp"
#include "simulator/scene/values.hpp"

namespace shakebed::simulator {

namespace {

using files::Error;
using files::Fault;
using files::YamlNode;

constexpr long schema = 1;

void append(std::vector<Fault>& faults, const Error& error) {
  faults.insert(faults.end(), error.faults().begin(), error.faults().end());
}

/// Keys of another schema may mean other things, so nothing else is said about such a file.
void refuse_other_schema(const SceneValues& values) {
  const auto number = values.integer("scene");
  if (!number || *number == schema) return;
  throw files::bad_input(values.where("scene"),
                         "`scene`: this program reads scenes of schema 1, got schema " +
                             std::to_string(*number) +
                             "; use the program version that the scene was written for");
}

Scene read_checked(const YamlNode& root, const std::vector<Override>& overrides,
                   std::vector<Fault> faults) {
  YamlNode whole = root;
  try {
    whole = with_overrides(root, overrides);
  } catch (const Error& error) {
    append(faults, error);
  }
  SceneValues values(whole, faults);
  refuse_other_schema(values);
  Scene scene;
  if (whole.is_map()) scene = scene_from(values);
  if (!faults.empty()) throw Error(Error::Kind::bad_input, std::move(faults));
  return scene;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  std::vector<Fault> faults;
  const YamlNode root = YamlNode::load_text(files::read_text(file), file.string(), faults);
  return read_checked(root, overrides, std::move(faults));
}

Scene read_scene(const YamlNode& root, const std::vector<Override>& overrides) {
  return read_checked(root, overrides, {});
}

}  // namespace shakebed::simulator
