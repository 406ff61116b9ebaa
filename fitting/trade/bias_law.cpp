#include "fitting/trade/bias_law.hpp"

#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "fitting/gsl.hpp"

namespace shakebed::fitting::trade {
namespace {

using files::CsvTable;
using files::number_text;

const std::string steps_axis = "dt closed";
const std::string stiffness_axis = "k_n";

/// Softer grains than this change the bed in ways of their own.
constexpr double softest = 0.1;

/// Near the onset softness counts for three times as much (6 % of T_z at k_n of `auto` and W
/// = 2.5); `accuracy` promises nothing there, so that others need not pay for it.
constexpr double least_promised_W = 5;

/// Rows without W are of tables that have none.
bool is_promised(const CsvTable& table, std::size_t row) {
  return !table.has_column("W") || table.number(row, table.column("W")) >= least_promised_W;
}

CsvTable promised_scenes(const CsvTable& table) {
  CsvTable some(table.columns());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!is_promised(table, row)) continue;
    std::vector<std::string> cells;
    for (std::size_t k = 0; k < table.columns().size(); ++k) cells.push_back(table.text(row, k));
    some.add_row(std::move(cells));
  }
  return some;
}

/// What tells a scene of one kind from another.
const std::vector<files::CsvColumn> scene_numbers{{"dimension", "1"},   {"rough", "1"},
                                                  {"W", "1"},           {"layers", "1"},
                                                  {"restitution", "1"}, {"amplitude", "d"}};

std::vector<std::string> numbers_of(const CsvTable& table, const std::string& scene) {
  std::vector<std::string> numbers;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, table.column("scene")) != scene) continue;
    for (const auto& number : scene_numbers) {
      const bool known = table.has_column(number.name);
      numbers.push_back(known ? table.text(row, table.column(number.name)) : "");
    }
    break;
  }
  return numbers;
}

struct Points {
  std::vector<double> x, y, weight;
  void add(double at, double value, double error) {
    x.push_back(at);
    y.push_back(value);
    weight.push_back(1 / (error * error));
  }
};

/// Names in order of first appearance.
std::vector<std::string> scenes_of(const CsvTable& table) {
  std::vector<std::string> names;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto& name = table.text(row, table.column("scene"));
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

Points points_of(const CsvTable& table, const std::string& scene, const std::string& axis) {
  Points points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.text(row, table.column("scene")) != scene) continue;
    if (table.text(row, table.column("axis")) != axis) continue;
    const double value = table.number(row, table.column("value"));
    if (axis == stiffness_axis && value < softest) continue;
    const double T_z = table.number(row, table.column("T_z"));
    const double error = table.number(row, table.column("T_z_se"));
    if (!(T_z > 0) || !(error > 0)) continue;
    points.add(abscissa(axis, value), T_z, error);
  }
  return points;
}

BiasLaw law_of(const Points& points, const std::string& scene, const std::string& axis) {
  double T_0 = 0, slope = 0, v00 = 0, v01 = 0, v11 = 0, chi_squared = 0;
  gsl::quiet();
  gsl::check(gsl_fit_wlinear(points.x.data(), 1, points.weight.data(), 1, points.y.data(), 1,
                             points.x.size(), &T_0, &slope, &v00, &v01, &v11, &chi_squared),
             "the bias of " + scene + " along " + axis);
  const double c = slope / T_0;
  const double variance = (v11 - 2 * c * v01 + c * c * v00) / (T_0 * T_0);
  const std::size_t freedom = points.x.size() - 2;
  const double scale = std::max(1.0, chi_squared / static_cast<double>(freedom));
  return {scene, axis, c, std::sqrt(variance * scale), chi_squared, freedom, {}};
}

/// CPU time of a setting over the reference's, averaged over the scenes in the logarithm.
struct RelativeCost {
  double logarithms = 0;
  int scenes = 0;
};

std::map<std::pair<std::string, double>, RelativeCost> relative_costs(const CsvTable& table) {
  std::map<std::string, double> reference;
  std::map<std::pair<std::string, double>, RelativeCost> costs;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto& scene = table.text(row, table.column("scene"));
    const auto& axis = table.text(row, table.column("axis"));
    const double seconds = table.number(row, table.column("seconds_per_1000_cycles"));
    if (axis == "reference") reference[scene] = seconds;
    auto& cost = costs[{axis, table.number(row, table.column("value"))}];
    cost.logarithms += std::log(seconds / reference.at(scene));
    ++cost.scenes;
  }
  return costs;
}

}  // namespace

double abscissa(const std::string& axis, double value) {
  return axis == stiffness_axis ? 1 / std::sqrt(value) : 1 / (value * value);
}

std::vector<BiasLaw> bias_laws(const CsvTable& table, const std::string& axis) {
  std::vector<BiasLaw> laws;
  for (const auto& scene : scenes_of(table)) {
    const Points points = points_of(table, scene, axis);
    if (points.x.size() < 3) continue;
    laws.push_back(law_of(points, scene, axis));
    laws.back().numbers = numbers_of(table, scene);
  }
  return laws;
}

double bias_bound(const std::vector<BiasLaw>& laws) {
  constexpr double one_sided_95_percent = 1.64;
  double bound = 0;
  for (const auto& law : laws) {
    bound = std::max(bound, std::abs(law.coefficient) + one_sided_95_percent * law.error);
  }
  return bound;
}

CsvTable law_table(const std::vector<BiasLaw>& laws) {
  std::vector<files::CsvColumn> columns{{"scene", ""}, {"axis", ""}};
  columns.insert(columns.end(), scene_numbers.begin(), scene_numbers.end());
  columns.insert(columns.end(), {{"coefficient", "1"},
                                 {"coefficient_se", "1"},
                                 {"chi_squared", "1"},
                                 {"degrees_of_freedom", "1"}});
  CsvTable table(std::move(columns));
  for (const auto& law : laws) {
    std::vector<std::string> row{law.scene, law.axis};
    row.insert(row.end(), law.numbers.begin(), law.numbers.end());
    row.insert(row.end(), {number_text(law.coefficient), number_text(law.error),
                           number_text(law.chi_squared), std::to_string(law.degrees_of_freedom)});
    table.add_row(std::move(row));
  }
  return table;
}

CsvTable accuracy_table(const CsvTable& trade) {
  CsvTable table(
      {{"axis", ""}, {"value", "1"}, {"bias_bound", "%"}, {"relative_cost", "1"}, {"scenes", "1"}});
  const CsvTable promised = promised_scenes(trade);
  const auto costs = relative_costs(promised);
  for (const auto& axis : {steps_axis, stiffness_axis}) {
    const auto laws = bias_laws(promised, axis);
    const double bound = bias_bound(laws);
    for (const auto& [setting, cost] : costs) {
      const auto& [name, value] = setting;
      if (name != axis || (axis == stiffness_axis && value < softest)) continue;
      table.add_row({axis, number_text(value), number_text(100 * bound * abscissa(axis, value)),
                     number_text(std::exp(cost.logarithms / cost.scenes)),
                     std::to_string(laws.size())});
    }
  }
  table.provenance = trade.provenance;
  return table;
}

}  // namespace shakebed::fitting::trade
