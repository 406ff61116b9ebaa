#include "sweeps/axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "simulator/scene/keys.hpp"

namespace shakebed::sweeps {
namespace {

using files::YamlNode;

constexpr double most_values_of_an_axis = 1e5;

/// "5 5" for [5, 5]: a cell of the table holds one line.
std::string label_of(const YamlNode& value) {
  if (value.is_scalar()) return value.as_string();
  if (!value.is_sequence()) {
    throw value.error("expected a number, a word or a list; bundles of keys belong under `cases`");
  }
  std::string label;
  for (const auto& element : value.elements()) {
    label += (label.empty() ? "" : " ") + element.as_string();
  }
  return label;
}

std::vector<Choice> listed(const std::string& key, const YamlNode& list) {
  std::vector<Choice> choices;
  for (const auto& value : list.elements()) {
    choices.push_back({label_of(value), {{key, value.to_text(), value.where()}}});
  }
  return choices;
}

std::size_t checked_count(const YamlNode& range, double count) {
  if (count >= 1 && count <= most_values_of_an_axis) return static_cast<std::size_t>(count);
  throw range.error("expected 1 to " + files::number_text(most_values_of_an_axis) +
                    " values, got " + files::number_text(count));
}

std::vector<double> stepped(const YamlNode& range, double from, double to) {
  range.refuse_unknown_keys({"from", "to", "step"});
  const YamlNode step_node = range.at("step");
  const double step = step_node.as_double();
  if (step == 0 || (to - from) / step < 0) {
    throw step_node.error("a step of " + files::number_text(step) + " does not lead from " +
                          files::number_text(from) + " to " + files::number_text(to));
  }
  // A share of a step is forgiven, so that 0.1, 0.2, ..., 1 reaches 1.
  const std::size_t count = checked_count(range, std::floor((to - from) / step + 1e-6) + 1);
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) values.push_back(from + static_cast<double>(k) * step);
  return values;
}

std::vector<double> spaced(const YamlNode& range, double from, double to) {
  range.refuse_unknown_keys({"from", "to", "count", "spacing"});
  const std::size_t count =
      checked_count(range, static_cast<double>(range.at("count").as_integer()));
  bool logarithmic = false;
  if (const auto spacing = range.find("spacing")) {
    const std::string word = spacing->as_string();
    if (word != "linear" && word != "log") {
      throw spacing->error("expected linear or log, got " + word);
    }
    logarithmic = word == "log";
    if (logarithmic && (from <= 0 || to <= 0)) {
      throw range.error("logarithmic spacing needs positive ends");
    }
  }
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = count == 1 ? 0 : static_cast<double>(k) / static_cast<double>(count - 1);
    const bool last = k + 1 == count && count > 1;
    const double between =
        logarithmic ? from * std::pow(to / from, share) : from + share * (to - from);
    values.push_back(last ? to : between);
  }
  return values;
}

/// 12 digits: what is below is rounding of the steps, not a wish of the user.
double without_rounding(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.12g", value);
  return std::stod(digits);
}

std::vector<Choice> ranged(const std::string& key, const YamlNode& range) {
  const double from = range.at("from").as_double();
  const double to = range.at("to").as_double();
  std::vector<Choice> choices;
  for (const double value :
       range.has("count") ? spaced(range, from, to) : stepped(range, from, to)) {
    const std::string text = files::number_text(without_rounding(value));
    choices.push_back({text, {{key, text, range.where()}}});
  }
  return choices;
}

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

std::string unit_of(const std::string& key) {
  if (key.ends_with("_rpm")) return "rpm";
  const simulator::Key* row = simulator::find_scene_key(key);
  return row == nullptr ? "" : std::string(row->unit);
}

AxisColumn read_cases(const YamlNode& node) {
  node.refuse_unknown_keys({"cases", "values"});
  AxisColumn axis{{node.at("cases").as_string(), ""}, "", node.where(), {}};
  for (const auto& [name, bundle] : node.at("values").items()) {
    axis.choices.push_back({name, read_overrides(bundle)});
  }
  return axis;
}

AxisColumn read_keyed(const YamlNode& node) {
  node.refuse_unknown_keys({"key", "values", "range", "as", "unit"});
  const std::string key = node.at("key").as_string();
  const auto name = node.find("as");
  const auto unit = node.find("unit");
  AxisColumn axis{
      {name ? name->as_string() : last_part(key), unit ? unit->as_string() : unit_of(key)},
      key,
      node.where(),
      {}};
  if (node.has("values") == node.has("range")) {
    throw node.error("expected either `values` or `range`");
  }
  axis.choices =
      node.has("values") ? listed(key, node.at("values")) : ranged(key, node.at("range"));
  return axis;
}

AxisColumn read_column(const YamlNode& node) {
  AxisColumn axis = node.has("cases") ? read_cases(node) : read_keyed(node);
  if (axis.choices.empty()) throw node.error("an axis needs at least one value");
  return axis;
}

}  // namespace

std::vector<simulator::Override> read_overrides(const YamlNode& node) {
  std::vector<simulator::Override> overrides;
  for (const auto& [path, value] : node.items()) {
    overrides.push_back({path, value.to_text(), value.where()});
  }
  return overrides;
}

void AxisColumn::replace_choices(const YamlNode& node) {
  if (!key.empty()) {
    choices = node.is_map() ? ranged(key, node) : listed(key, node);
  } else {
    std::vector<Choice> kept;
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.label);
    for (const auto& wanted : node.elements()) {
      const auto found = std::find(names.begin(), names.end(), wanted.as_string());
      if (found == names.end()) {
        const auto near = files::nearest_word(wanted.as_string(), names);
        throw wanted.error("there is no case `" + wanted.as_string() + "` of `" + column.name +
                           "`" + (near ? "; did you mean `" + *near + "`?" : ""));
      }
      kept.push_back(choices[static_cast<std::size_t>(found - names.begin())]);
    }
    choices = kept;
  }
  if (choices.empty()) throw node.error("an axis needs at least one value");
}

Axis read_axis(const YamlNode& node) {
  if (!node.has("zip")) return {{read_column(node)}};
  node.refuse_unknown_keys({"zip"});
  Axis axis;
  for (const auto& part : node.at("zip").elements()) {
    axis.columns.push_back(read_column(part));
    const std::size_t expected = axis.columns.front().choices.size();
    const std::size_t got = axis.columns.back().choices.size();
    if (got != expected) {
      throw part.error("zipped axes need equally many values: the first has " +
                       std::to_string(expected) + ", this one " + std::to_string(got));
    }
  }
  if (axis.columns.empty()) throw node.error("zip needs at least one axis");
  return axis;
}

}  // namespace shakebed::sweeps
