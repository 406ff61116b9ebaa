#include <algorithm>
#include <cctype>

#include "files/yaml_tree.hpp"

namespace shakebed::files {

namespace {

using Kind = YamlNode::Kind;
using Shared = std::shared_ptr<const YamlTree>;

std::pair<std::string, std::string_view> first_key(std::string_view path) {
  const std::size_t dot = path.find('.');
  if (dot == std::string_view::npos) return {std::string(path), {}};
  return {std::string(path.substr(0, dot)), path.substr(dot + 1)};
}

/// A copy of `tree` with the node at `path` replaced; maps that are missing are made, and a word
/// or nothing on the way ("transient: auto") gives way to a map.
Shared with_node(const YamlTree& tree, std::string_view path, const Shared& node,
                 const std::string& origin) {
  if (tree.kind == Kind::sequence) {
    throw bad_input(origin,
                    "`" + tree.path + "` is a list; set it as a whole: " + tree.path + "=[...]");
  }
  auto copy = std::make_shared<YamlTree>(tree);
  copy->kind = Kind::map;
  copy->text.clear();
  const auto [key, rest] = first_key(path);
  auto entry = std::find_if(copy->entries.begin(), copy->entries.end(),
                            [&key = key](const auto& one) { return one.key == key; });
  if (entry == copy->entries.end()) {
    auto empty = std::make_shared<YamlTree>();
    empty->where = origin;
    empty->path = child_path(tree.path, key);
    copy->entries.push_back({key, origin, std::move(empty)});
    entry = std::prev(copy->entries.end());
  }
  if (rest.empty()) {
    entry->where = origin;
    entry->value = node;
  } else {
    entry->value = with_node(*entry->value, rest, node, origin);
  }
  return copy;
}

Shared without_node(const Shared& tree, std::string_view path) {
  const auto [key, rest] = first_key(path);
  if (tree->find(key) == nullptr) return tree;
  auto copy = std::make_shared<YamlTree>(*tree);
  const auto entry = std::find_if(copy->entries.begin(), copy->entries.end(),
                                  [&key = key](const auto& one) { return one.key == key; });
  if (rest.empty()) {
    copy->entries.erase(entry);
  } else {
    entry->value = without_node(entry->value, rest);
  }
  return copy;
}

/// True when the text reads back as the same plain scalar in block style.
bool safe_without_quotes(const std::string& text) {
  if (text.empty() || text.back() == ' ') return false;
  const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
  const bool signed_number =
      text.size() > 1 && (text[0] == '-' || text[0] == '+') && (letter(text[1]) || text[1] == '.');
  if (!letter(text[0]) && text[0] != '_' && text[0] != '.' && !signed_number) return false;
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return letter(c) || std::string_view("_.+-*/^%() ").find(c) != std::string_view::npos;
  });
}

/// A word that YAML would read as null if it were not quoted.
bool null_word(const std::string& text) {
  return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

std::string double_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr char digits[] = "0123456789abcdef";
      const auto code = static_cast<unsigned char>(c);
      out += std::string("\\x") + digits[code / 16] + digits[code % 16];
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string word(const std::string& text, bool plain) {
  return plain && safe_without_quotes(text) && !null_word(text) ? text : double_quoted(text);
}

std::string key_word(const std::string& key) { return word(key, true); }

void append(std::string& out, const YamlTree& tree, std::size_t indent);

/// What follows "key:" or "-": on the same line when it is small, else a block below.
void append_value(std::string& out, const YamlTree& tree, std::size_t indent) {
  if (tree.kind == Kind::scalar) {
    out += " " + word(tree.text, tree.plain) + "\n";
  } else if (tree.kind == Kind::map && tree.entries.empty()) {
    out += " {}\n";
  } else if (tree.kind == Kind::sequence && tree.elements.empty()) {
    out += " []\n";
  } else if (tree.kind == Kind::null) {
    out += "\n";
  } else {
    out += "\n";
    append(out, tree, indent);
  }
}

void append(std::string& out, const YamlTree& tree, std::size_t indent) {
  const std::string margin(indent, ' ');
  for (const auto& entry : tree.entries) {
    out += margin + key_word(entry.key) + ":";
    append_value(out, *entry.value, indent + 2);
  }
  for (const auto& element : tree.elements) {
    out += margin + "-";
    append_value(out, *element, indent + 2);
  }
}

}  // namespace

YamlNode YamlNode::with(std::string_view path, std::string_view value, std::string origin) const {
  std::vector<Fault> faults;
  const YamlSource source{origin, origin, child_path(tree_->path, path)};
  const Shared node = parse_yaml(value, source, faults);
  if (!faults.empty()) throw Error(Error::Kind::bad_input, std::move(faults));
  if (path.empty() || path.front() == '.' || path.back() == '.' ||
      path.find("..") != std::string_view::npos) {
    throw bad_input(
        origin, "expected a path of keys such as base.drive.W, got `" + std::string(path) + "`");
  }
  return YamlNode(with_node(*tree_, path, node, origin));
}

YamlNode YamlNode::without(std::string_view path) const {
  return YamlNode(without_node(tree_, path));
}

std::string YamlNode::to_text() const {
  std::string out;
  if (is_map() || is_sequence()) {
    append_value(out, *tree_, 0);
    // The root stands at the margin, after no key.
    out.erase(0, 1);
  } else if (is_scalar()) {
    out = word(tree_->text, tree_->plain) + "\n";
  }
  return out;
}

}  // namespace shakebed::files
