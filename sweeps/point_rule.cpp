#include "sweeps/point_rule.hpp"

#include <algorithm>

namespace shakebed::sweeps {
namespace {

using files::YamlNode;

std::string known_label(const YamlNode& node, const AxisColumn& column) {
  const std::string label = node.as_string();
  std::string known;
  for (const auto& choice : column.choices) {
    if (choice.label == label) return label;
    known += (known.empty() ? "" : ", ") + choice.label;
  }
  throw node.error("no point of this profile has " + column.column.name + " = " + label +
                   "; there are " + known);
}

PointRule read_point_rule(const YamlNode& node, const std::vector<AxisColumn>& columns) {
  node.refuse_unknown_keys({"where", "set"});
  const YamlNode where = node.at("where");
  std::vector<std::string> names;
  for (const auto& column : columns) names.push_back(column.column.name);
  where.refuse_unknown_keys(names);
  PointRule rule;
  for (const auto& [name, values] : where.items()) {
    const auto index =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    rule.where.push_back({index, {}});
    for (const auto& value : values.elements()) {
      rule.where.back().labels.push_back(known_label(value, columns[index]));
    }
  }
  if (rule.where.empty()) throw where.error("expected at least one column with its values");
  rule.overrides = read_overrides(node.at("set"));
  return rule;
}

}  // namespace

bool PointRule::applies_to(const std::vector<std::string>& labels) const {
  return std::all_of(where.begin(), where.end(), [&](const Condition& condition) {
    const auto& wanted = condition.labels;
    return std::find(wanted.begin(), wanted.end(), labels[condition.column]) != wanted.end();
  });
}

std::vector<PointRule> read_point_rules(const YamlNode& list, const std::vector<Axis>& axes) {
  std::vector<AxisColumn> columns;
  for (const auto& axis : axes) {
    columns.insert(columns.end(), axis.columns.begin(), axis.columns.end());
  }
  std::vector<PointRule> rules;
  for (const auto& node : list.elements()) rules.push_back(read_point_rule(node, columns));
  return rules;
}

}  // namespace shakebed::sweeps
