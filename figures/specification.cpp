#include "figures/specification.hpp"

#include <algorithm>
#include <cctype>

#include "files/yaml.hpp"

namespace shakebed::figures {
namespace {

using files::YamlNode;

std::vector<std::string> one_or_more_words(const YamlNode& node) {
  if (node.is_scalar()) return {node.as_string()};
  if (!node.is_sequence() || node.elements().empty()) {
    throw node.error("expected a word or a list of words");
  }
  std::vector<std::string> words;
  for (const auto& element : node.elements()) words.push_back(element.as_string());
  return words;
}

// Names become gnuplot variables and parts of file names.
std::string plain_name(const YamlNode& node, const std::string& name) {
  const bool good = !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) &&
                    std::all_of(name.begin(), name.end(),
                                [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!good) {
    throw node.error("'" + name + "' must be letters, digits and '_', starting with a letter");
  }
  return name;
}

std::filesystem::path beside(const std::filesystem::path& specification, const YamlNode& node) {
  return (specification.parent_path() / node.as_string()).lexically_normal();
}

std::optional<int> read_digits(const YamlNode& node) {
  const auto digits = node.find("digits");
  if (!digits) return std::nullopt;
  if (digits->as_integer() < 1 || digits->as_integer() > 17) {
    throw digits->error("expected 1 to 17 significant digits");
  }
  return static_cast<int>(digits->as_integer());
}

PartColumn read_column(const YamlNode& node) {
  if (node.is_scalar()) {
    const auto name = plain_name(node, node.as_string());
    return {CopiedColumn{name, name, std::nullopt}, node.where()};
  }
  if (!node.is_map()) {
    throw node.error("expected a column name, {column: name, as: name} or {state: ...}");
  }
  if (const auto state = node.find("state")) {
    node.refuse_unknown_keys({"state", "as"});
    state->refuse_unknown_keys({"stationary", "at_rest"});
    StateColumn column{state->at("stationary").as_string(), state->at("at_rest").as_string()};
    if (const auto as = node.find("as")) column.as = plain_name(*as, as->as_string());
    return {column, node.where()};
  }
  node.refuse_unknown_keys({"column", "as", "digits", "state"});
  const auto name = node.at("column").as_string();
  const auto as = node.find("as");
  return {CopiedColumn{name, plain_name(node, as ? as->as_string() : name), read_digits(node)},
          node.where()};
}

Part read_part(const std::filesystem::path& specification, const std::string& name,
               const YamlNode& node) {
  node.refuse_unknown_keys({"title", "from", "file", "where", "columns"});
  Part part;
  part.name = plain_name(node, name);
  part.where = node.where();
  if (const auto title = node.find("title")) part.title = title->as_string();
  const auto from = node.find("from");
  const auto file = node.find("file");
  if (from.has_value() == file.has_value()) {
    throw node.error("a part needs exactly one of 'from' (tables) and 'file'");
  }
  if (from) part.source = NamedTables{one_or_more_words(*from)};
  if (file) part.source = TableFile{beside(specification, *file)};
  if (const auto where = node.find("where")) {
    for (const auto& [column, words] : where->items()) {
      part.filters.push_back({column, one_or_more_words(words), words.where()});
    }
  }
  if (const auto columns = node.find("columns")) {
    for (const auto& column : columns->elements()) part.columns.push_back(read_column(column));
  }
  return part;
}

std::pair<int, int> read_size(const YamlNode& node) {
  const auto size = node.elements();
  if (size.size() != 2) throw node.error("expected [width, height] in pixels");
  for (const auto& side : size) {
    if (side.as_integer() < 100 || side.as_integer() > 10000) {
      throw side.error("expected 100 to 10000 pixels");
    }
  }
  return {static_cast<int>(size[0].as_integer()), static_cast<int>(size[1].as_integer())};
}

}  // namespace

std::vector<std::string> Specification::table_names() const {
  std::vector<std::string> names;
  for (const auto& part : parts) {
    const auto* named = std::get_if<NamedTables>(&part.source);
    if (named == nullptr) continue;
    for (const auto& name : named->names) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

Specification read_specification(const std::filesystem::path& file) {
  const auto root = YamlNode::load_file(file);
  root.refuse_unknown_keys({"figure", "id", "title", "script", "size", "parts", "notes"});
  if (root.at("figure").as_integer() != 1) {
    throw root.at("figure").error("this program reads figure specifications of schema 1");
  }
  Specification specification;
  specification.id = root.at("id").as_string();
  specification.title = root.at("title").as_string();
  for (const auto& [name, part] : root.at("parts").items()) {
    specification.parts.push_back(read_part(file, name, part));
  }
  if (specification.parts.empty()) throw root.at("parts").error("expected at least one part");
  if (const auto script = root.find("script")) specification.script = beside(file, *script);
  if (const auto size = root.find("size")) specification.size = read_size(*size);
  if (const auto notes = root.find("notes")) specification.notes = one_or_more_words(*notes);
  if (specification.is_picture() ? root.has("notes") : root.has("size")) {
    throw root.error("'size' belongs to a picture (with 'script'), 'notes' to a printed table");
  }
  return specification;
}

}  // namespace shakebed::figures
