#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/error.hpp"

namespace shakebed::files {

struct YamlTree;

/// A node of a YAML file that knows its place and refuses what yaml-cpp lets pass: duplicate
/// keys, merge keys, octal-looking integers, several documents, wrong types, unknown keys.
/// Every refusal is an Error(bad_input) whose `where` is "file:line:column" (1-based).
class YamlNode {
 public:
  enum class Kind { null, scalar, sequence, map };

  static YamlNode load_file(const std::filesystem::path& file);
  static YamlNode load_text(std::string_view text, std::string name);
  /// As above, but what still leaves a readable tree (duplicate and merge keys, anchors, tags) goes
  /// to `faults`, so that a reader can report it together with its own findings.
  static YamlNode load_text(std::string_view text, std::string name, std::vector<Fault>& faults);

  Kind kind() const;
  bool is_map() const { return kind() == Kind::map; }
  bool is_sequence() const { return kind() == Kind::sequence; }
  bool is_scalar() const { return kind() == Kind::scalar; }

  std::string where() const;                          ///< "file:line:column"
  std::string key_where(std::string_view key) const;  ///< of the key itself, in a map
  const std::string& path() const;  ///< dotted path of keys from the root: "base.drive.W"

  bool has(std::string_view key) const;
  YamlNode at(std::string_view key) const;                      ///< throws when the key is missing
  std::optional<YamlNode> find(std::string_view key) const;     ///< nullopt when it is missing
  std::vector<std::pair<std::string, YamlNode>> items() const;  ///< a map's, in file order
  std::vector<YamlNode> elements() const;                       ///< a sequence's

  double as_double() const;  ///< finite; "1e3", "2", "0.5" (never nan or inf)
  long as_integer() const;   ///< also "1e3" when it is whole; refuses "010"
  bool as_bool() const;      ///< true or false only
  std::string as_string() const;

  /// Refuses every key of this map that is not allowed, naming the nearest allowed one.
  void refuse_unknown_keys(std::initializer_list<std::string_view> allowed) const;
  void refuse_unknown_keys(const std::vector<std::string>& allowed) const;

  /// An Error(bad_input) at this node's place, to throw or to collect.
  Error error(const std::string& what) const;

  /// The tree with `path` ("base.drive.W") set to the YAML text `value`; places of the new node
  /// read as `origin` (for instance "--set base.drive.W=30").
  YamlNode with(std::string_view path, std::string_view value, std::string origin) const;
  YamlNode without(std::string_view path) const;

  std::string to_text() const;  ///< the tree as block YAML, keys in file order

 private:
  std::shared_ptr<const YamlTree> tree_;
  explicit YamlNode(std::shared_ptr<const YamlTree> tree) : tree_(std::move(tree)) {}
};

/// The word of `known` with the smallest edit distance to `word`, when it is near enough to help.
std::optional<std::string> nearest_word(std::string_view word,
                                        const std::vector<std::string>& known);

}  // namespace shakebed::files
