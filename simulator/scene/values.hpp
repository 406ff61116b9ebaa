#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "files/yaml.hpp"
#include "simulator/scene/keys.hpp"

namespace shakebed::simulator {

/// The values of a scene's file, each checked against its row of the table of keys on its own:
/// known key, type, range. What is wrong goes to `faults`; nothing is thrown.
class SceneValues {
 public:
  SceneValues(const files::YamlNode& root, std::vector<files::Fault>& faults);

  /// Whether the file gives the key, rightly or wrongly, or any key below it.
  bool given(std::string_view path) const;

  /// Whether the key, one that seems to mean it, or a map that should hold it was refused: its
  /// absence says nothing then.
  bool refused(std::string_view path) const;

  // Empty when the key is absent or was refused.
  std::optional<double> number(std::string_view path) const { return get<double>(path); }
  std::optional<long> integer(std::string_view path) const { return get<long>(path); }
  std::optional<bool> boolean(std::string_view path) const { return get<bool>(path); }
  std::optional<std::string> word(std::string_view path) const { return get<std::string>(path); }
  std::optional<std::vector<double>> numbers(std::string_view path) const {
    return get<std::vector<double>>(path);
  }

  /// Place of the key's value, or of the innermost map that should have held it.
  std::string where(std::string_view path) const;
  void report(std::string_view path, const std::string& what);  ///< a fault at the key's place

 private:
  using Value = std::variant<std::monostate, double, long, bool, std::string, std::vector<double>>;

  template <class T>
  std::optional<T> get(std::string_view path) const {
    const auto found = values_.find(path);
    if (found == values_.end()) return std::nullopt;
    const T* value = std::get_if<T>(&found->second);
    return value ? std::optional<T>(*value) : std::nullopt;
  }

  void read_map(const files::YamlNode& map, const std::string& prefix);
  void read_item(const files::YamlNode& node, const std::string& path);
  void report_unknown(const files::YamlNode& map, const std::string& prefix,
                      const std::string& name);
  void report_missing();

  std::vector<files::Fault>& faults_;
  std::map<std::string, Value, std::less<>> values_;
  std::map<std::string, std::string, std::less<>> places_;  ///< of values and of maps
};

}  // namespace shakebed::simulator
