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
  return {scene, axis, c, std::sqrt(variance * scale), chi_squared, freedom};
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
    if (points.x.size() >= 3) laws.push_back(law_of(points, scene, axis));
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
  CsvTable table({{"scene", ""},
                  {"axis", ""},
                  {"coefficient", "1"},
                  {"coefficient_se", "1"},
                  {"chi_squared", "1"},
                  {"degrees_of_freedom", "1"}});
  for (const auto& law : laws) {
    table.add_row({law.scene, law.axis, number_text(law.coefficient), number_text(law.error),
                   number_text(law.chi_squared), std::to_string(law.degrees_of_freedom)});
  }
  return table;
}

CsvTable accuracy_table(const CsvTable& trade) {
  CsvTable table(
      {{"axis", ""}, {"value", "1"}, {"bias_bound", "%"}, {"relative_cost", "1"}, {"scenes", "1"}});
  const auto costs = relative_costs(trade);
  for (const auto& axis : {steps_axis, stiffness_axis}) {
    const auto laws = bias_laws(trade, axis);
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
