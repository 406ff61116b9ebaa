#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"
#include "files/yaml.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::sweeps {

/// One value on an axis: what the table's cell says, and the scene keys it sets.
struct Choice {
  std::string label;
  std::vector<simulator::Override> overrides;
};

/// A column of the collected table and the choices on it. It is one of
///   {key: base.drive.W, values: [1, 2, 4], as: W}
///   {key: base.drive.frequency_rpm, range: {from: 300, to: 4000, step: 100}}
///   {key: base.drive.W, range: {from: 0.5, to: 500, count: 16, spacing: log}}
///   {cases: system, values: {"2D smooth": {dimension: 2, cell: [10]}, ...}}
/// `as` names the column (default: the key's last part), `unit` its unit (default: the key's).
struct AxisColumn {
  files::CsvColumn column;
  std::string key;  ///< empty for cases
  std::string where;
  std::vector<Choice> choices;

  /// Other choices for the same column, as a profile gives them: a list or range of values of the
  /// key, or a list of names of the cases.
  void replace_choices(const files::YamlNode& node);
};

/// One direction of the grid: a column, or several of equal length that step together,
///   {zip: [{key: ..., values: ...}, {key: ..., values: ...}]}.
struct Axis {
  std::vector<AxisColumn> columns;
  std::size_t size() const { return columns.front().choices.size(); }
};

Axis read_axis(const files::YamlNode& node);

/// {"path.of.key": value, ...} as overrides that know their place.
std::vector<simulator::Override> read_overrides(const files::YamlNode& node);

}  // namespace shakebed::sweeps
