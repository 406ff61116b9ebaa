#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "files/yaml.hpp"

namespace shakebed::files {

/// What YamlNode points into. Never changed once built: edits copy the maps along their path.
struct YamlTree {
  struct Entry {
    std::string key;
    std::string where;  ///< of the key
    std::shared_ptr<const YamlTree> value;
  };

  YamlNode::Kind kind = YamlNode::Kind::null;
  std::string where;
  std::string path;
  std::string text;    ///< of a scalar
  bool plain = false;  ///< a scalar written without quotes, the only kind that can be a number
  std::vector<Entry> entries;
  std::vector<std::shared_ptr<const YamlTree>> elements;

  const Entry* find(std::string_view key) const {
    for (const auto& entry : entries) {
      if (entry.key == key) return &entry;
    }
    return nullptr;
  }
};

inline std::string child_path(const std::string& parent, std::string_view key) {
  return parent.empty() ? std::string(key) : parent + "." + std::string(key);
}

/// Where the nodes of a text are: at name:line:column, or all of them at one `origin`.
struct YamlSource {
  std::string name;
  std::string origin;     ///< "--set W=3"; empty for a file
  std::string root_path;  ///< path of the root of this text in the whole tree
};

/// Throws Error(bad_input) for a syntax error; milder faults go to `faults`.
std::shared_ptr<const YamlTree> parse_yaml(std::string_view text, const YamlSource& source,
                                           std::vector<Fault>& faults);

}  // namespace shakebed::files
