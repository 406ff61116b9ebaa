#include "fitting/fit_file_parts.hpp"

#include <cctype>
#include <cmath>
#include <optional>

#include "fitting/models/all.hpp"

namespace shakebed::fitting {

using files::YamlNode;

namespace {

RangeBound read_bound(const YamlNode& node, const std::string& column) {
  using Kind = RangeBound::Kind;
  const std::string text = node.as_string();
  if (text == "start") return {Kind::start};
  if (text == "end") return {Kind::end};
  if (text == "peak" || text == "W_2") {
    if (column != "W") throw node.error("`" + text + "` bounds a range in W, not in " + column);
    return {text == "peak" ? Kind::peak : Kind::W_2};
  }
  const bool word = !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0;
  if (word) throw node.error("expected a number, peak, W_2, start or end; got " + text);
  return {Kind::number, node.as_double()};
}

PrintedValue read_printed(const YamlNode& node) {
  const std::string text = node.as_string();
  const std::size_t point = text.find('.');
  const std::size_t digits = point == std::string::npos ? 0 : text.size() - point - 1;
  return {node.as_double(), 0.5 * std::pow(10.0, -double(digits))};
}

}  // namespace

std::vector<YamlNode> one_or_more(const YamlNode& node) {
  const auto nodes = node.is_sequence() ? node.elements() : std::vector<YamlNode>{node};
  if (nodes.empty()) throw node.error("expected at least one entry");
  return nodes;
}

double positive(const YamlNode& node) {
  const double value = node.as_double();
  if (!(value > 0)) throw node.error("expected a positive number, got " + node.as_string());
  return value;
}

double share(const YamlNode& node) {
  const double value = node.as_double();
  if (!(value > 0 && value <= 1)) {
    throw node.error("expected a share above 0 and at most 1, got " + node.as_string());
  }
  return value;
}

std::vector<Filter> read_select(const YamlNode& node) {
  std::vector<Filter> filters;
  for (const auto& [column, value] : node.items()) {
    filters.push_back({column, value.as_string(), value.where()});
  }
  return filters;
}

Exclusion read_exclusion(const YamlNode& node) {
  const std::string because = node.at("because").as_string();
  const auto items = node.items();
  if (items.size() != 2) {
    throw node.error("expected one column with [from, to] and `because`");
  }
  const auto& [column, limits] = items[0].first == "because" ? items[1] : items[0];
  const auto ends = limits.elements();
  if (ends.size() != 2) throw limits.error("expected [from, to]");
  return {column, ends[0].as_double(), ends[1].as_double(), because};
}

namespace {

/// How far the ends of a reconstructed range may be off.
constexpr double uncertain_low = 0.7;
constexpr double uncertain_high = 1.4;

RangeSpecification range_of_study(const YamlNode& node, const files::CsvTable* studies) {
  node.refuse_unknown_keys({"study"});
  const YamlNode key = node.at("study");
  if (studies == nullptr) throw key.error("`study` needs a table of `studies` in this file");
  for (std::size_t row = 0; row < studies->rows(); ++row) {
    if (studies->text(row, studies->column("key")) != key.as_string()) continue;
    const auto bound = [&](const char* column) {
      return RangeBound{RangeBound::Kind::number, studies->number(row, studies->column(column))};
    };
    RangeSpecification range;
    range.from = bound("W_from");
    range.to = bound("W_to");
    range.certain = studies->text(row, studies->column("provenance")) == "given";
    if (!range.certain) range.stretch = {uncertain_low, uncertain_high};
    return range;
  }
  throw key.error("no study '" + key.as_string() + "' in " + studies->name);
}

}  // namespace

RangeSpecification read_range(const YamlNode& node, const files::CsvTable* studies) {
  if (node.has("study")) return range_of_study(node, studies);
  RangeSpecification range;
  std::optional<YamlNode> limits;
  for (const auto& [key, value] : node.items()) {
    if (key == "stretch") {
      for (const auto& factor : value.elements()) range.stretch.push_back(positive(factor));
    } else if (key == "known") {
      range.certain = word_of<bool>(value, {{"given", true}, {"uncertain", false}});
    } else if (limits) {
      throw value.error("expected one column, `stretch` and `known`; a second column: " + key);
    } else {
      range.column = key;
      limits = value;
    }
  }
  if (!limits) throw node.error("expected a column with [from, to], for instance W: [peak, end]");
  const auto ends = limits->elements();
  if (ends.size() != 2) throw limits->error("expected [from, to]");
  range.from = read_bound(ends[0], range.column);
  range.to = read_bound(ends[1], range.column);
  const bool numbers =
      range.from.kind == RangeBound::Kind::number && range.to.kind == RangeBound::Kind::number;
  if (numbers && range.from.number >= range.to.number) {
    throw limits->error("the range is empty: from is not below to");
  }
  return range;
}

Reference read_reference(const YamlNode& node, const Model& model) {
  std::vector<std::string> known = model.parameters;
  known.insert(known.end(), {"correlation", "reported", "reported_error", "source"});
  node.refuse_unknown_keys(known);
  Reference reference;
  reference.source = node.at("source").as_string();
  for (const auto& name : model.parameters) {
    if (const auto value = node.find(name)) reference.parameters[name] = read_printed(*value);
  }
  const auto number = [&](std::string_view key) -> std::optional<double> {
    const auto value = node.find(key);
    return value ? std::optional(value->as_double()) : std::nullopt;
  };
  reference.correlation = number("correlation");
  reference.reported = number("reported");
  reference.reported_error = number("reported_error");
  return reference;
}

Model read_model(const YamlNode& node) {
  std::vector<std::pair<std::string, Model>> known;
  for (const auto& model : all_models()) known.emplace_back(model.name, model);
  return word_of<Model>(node, known);
}

}  // namespace shakebed::fitting
