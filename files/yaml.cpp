#include "files/yaml.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "files/atomic_file.hpp"
#include "files/csv.hpp"
#include "files/yaml_tree.hpp"

namespace shakebed::files {

namespace {

std::string described(const YamlTree& tree) {
  switch (tree.kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::map:
      return "a map {...}";
    case YamlNode::Kind::sequence:
      return "a list [...]";
    case YamlNode::Kind::scalar:
      break;
  }
  return tree.plain ? "`" + tree.text + "`" : "the quoted text \"" + tree.text + "\"";
}

Error expected(const YamlTree& tree, const std::string& what) {
  return bad_input(tree.where, (tree.path.empty() ? "" : "`" + tree.path + "`: ") + "expected " +
                                   what + ", got " + described(tree));
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// YAML 1.1 reads 010 as eight and others as ten, so neither is guessed.
void refuse_octal(const YamlTree& tree) {
  std::string_view digits = tree.text;
  if (digits.starts_with('-') || digits.starts_with('+')) digits.remove_prefix(1);
  if (digits.size() > 1 && digits[0] == '0' && is_digit(digits[1])) {
    throw bad_input(tree.where, "`" + tree.path + "`: " + tree.text +
                                    " starts with 0, which some readers take for octal; write "
                                    "the decimal number without the leading 0");
  }
}

}  // namespace

YamlNode YamlNode::load_file(const std::filesystem::path& file) {
  return load_text(read_text(file), file.string());
}

YamlNode YamlNode::load_text(std::string_view text, std::string name) {
  std::vector<Fault> faults;
  YamlNode root = load_text(text, std::move(name), faults);
  if (!faults.empty()) throw Error(Error::Kind::bad_input, std::move(faults));
  return root;
}

YamlNode YamlNode::load_text(std::string_view text, std::string name, std::vector<Fault>& faults) {
  return YamlNode(parse_yaml(text, {std::move(name), {}, {}}, faults));
}

YamlNode::Kind YamlNode::kind() const { return tree_->kind; }
std::string YamlNode::where() const { return tree_->where; }
const std::string& YamlNode::path() const { return tree_->path; }

std::string YamlNode::key_where(std::string_view key) const {
  const auto* entry = tree_->find(key);
  return entry ? entry->where : tree_->where;
}

bool YamlNode::has(std::string_view key) const { return tree_->find(key) != nullptr; }

std::optional<YamlNode> YamlNode::find(std::string_view key) const {
  const auto* entry = tree_->find(key);
  if (!entry) return std::nullopt;
  return YamlNode(entry->value);
}

YamlNode YamlNode::at(std::string_view key) const {
  if (kind() != Kind::map) throw expected(*tree_, "a map with the key `" + std::string(key) + "`");
  if (auto child = find(key)) return *child;
  throw bad_input(tree_->where, "the key `" + child_path(tree_->path, key) + "` is missing");
}

std::vector<std::pair<std::string, YamlNode>> YamlNode::items() const {
  if (kind() != Kind::map) throw expected(*tree_, "a map {key: value, ...}");
  std::vector<std::pair<std::string, YamlNode>> children;
  for (const auto& entry : tree_->entries) children.emplace_back(entry.key, YamlNode(entry.value));
  return children;
}

std::vector<YamlNode> YamlNode::elements() const {
  if (kind() != Kind::sequence) throw expected(*tree_, "a list [...]");
  std::vector<YamlNode> children;
  for (const auto& element : tree_->elements) children.push_back(YamlNode(element));
  return children;
}

double YamlNode::as_double() const {
  if (kind() != Kind::scalar || !tree_->plain) throw expected(*tree_, "a number");
  refuse_octal(*tree_);
  const auto value = number_from_text(tree_->text);
  if (!value || !std::isfinite(*value)) throw expected(*tree_, "a finite number");
  return *value;
}

long YamlNode::as_integer() const {
  if (kind() != Kind::scalar || !tree_->plain) throw expected(*tree_, "a whole number");
  refuse_octal(*tree_);
  std::string_view text = tree_->text;
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  long whole = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
  if (error == std::errc{} && end == text.data() + text.size()) return whole;

  const auto value = number_from_text(text);
  // Beyond 2^53 a double has lost the last digits of what was written.
  if (!value || *value != std::floor(*value) || std::abs(*value) > 9007199254740992.0) {
    throw expected(*tree_, "a whole number");
  }
  return static_cast<long>(*value);
}

bool YamlNode::as_bool() const {
  if (kind() == Kind::scalar && tree_->plain && tree_->text == "true") return true;
  if (kind() == Kind::scalar && tree_->plain && tree_->text == "false") return false;
  throw expected(*tree_, "true or false");
}

std::string YamlNode::as_string() const {
  if (kind() != Kind::scalar) throw expected(*tree_, "a word");
  return tree_->text;
}

void YamlNode::refuse_unknown_keys(std::initializer_list<std::string_view> allowed) const {
  refuse_unknown_keys(std::vector<std::string>(allowed.begin(), allowed.end()));
}

void YamlNode::refuse_unknown_keys(const std::vector<std::string>& allowed) const {
  if (kind() != Kind::map) throw expected(*tree_, "a map {key: value, ...}");
  std::vector<Fault> faults;
  for (const auto& entry : tree_->entries) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) != allowed.end()) continue;
    std::string what = "unknown key `" + child_path(tree_->path, entry.key) + "`";
    if (const auto near = nearest_word(entry.key, allowed)) {
      what += "; did you mean `" + *near + "`?";
    } else {
      what += "; known here:";
      for (const auto& key : allowed) what += " " + key;
    }
    faults.push_back({entry.where, std::move(what)});
  }
  if (!faults.empty()) throw Error(Error::Kind::bad_input, std::move(faults));
}

Error YamlNode::error(const std::string& what) const {
  return bad_input(tree_->where, (tree_->path.empty() ? "" : "`" + tree_->path + "`: ") + what);
}

}  // namespace shakebed::files
