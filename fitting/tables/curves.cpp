#include "fitting/tables/head.hpp"

namespace shakebed::fitting {

using files::CsvTable;

namespace {

constexpr std::size_t grid_points = 200;

/// From the first to the last fitted x, even in ln x where that exists.
std::vector<double> fine_grid(const FitResult& result) {
  const double first = result.measurements.points.front().x;
  const double last = result.measurements.points.back().x;
  std::vector<double> grid;
  for (std::size_t i = 0; i < grid_points; ++i) {
    const double share = double(i) / double(grid_points - 1);
    grid.push_back(first > 0 ? first * std::pow(last / first, share)
                             : first + (last - first) * share);
  }
  return grid;
}

/// The paper's parameters in the model's order; empty unless it prints all of them.
std::vector<double> paper_values(const FitResult& result) {
  std::vector<double> values;
  const auto& printed = result.specification.reference.parameters;
  for (const auto& name : result.specification.model.parameters) {
    const auto found = printed.find(name);
    if (found == printed.end()) return {};
    values.push_back(found->second.value);
  }
  return values;
}

/// How far the paper's curve at x may be off because its parameters are rounded: the sum of
/// |dy/dp| times half a unit of p's last printed digit.
double rounding_bound(const FitResult& result, const std::vector<double>& paper, double x) {
  const auto& model = result.specification.model;
  std::vector<double> slope(paper.size());
  model.gradient(x, paper, slope);
  double bound = 0;
  for (std::size_t k = 0; k < paper.size(); ++k) {
    bound += std::abs(slope[k]) *
             result.specification.reference.parameters.at(model.parameters[k]).half_unit;
  }
  return bound;
}

bool drawn(const FitResult& result) {
  return result.fitted() && result.variant.stretch_from == 1 && result.variant.stretch_to == 1;
}

/// The common unit of a column over all fits; empty when they differ.
template <class UnitOf>
std::string common_unit(const FitReport& report, UnitOf unit_of) {
  std::string unit;
  for (const auto& result : report.fits) {
    if (!result.fitted()) continue;
    if (unit.empty()) unit = unit_of(result);
    if (unit != unit_of(result)) return "";
  }
  return unit;
}

std::string common_x(const FitReport& report) {
  return common_unit(report, [](const FitResult& r) { return r.measurements.x_unit; });
}
std::string common_y(const FitReport& report) {
  return common_unit(report, [](const FitResult& r) { return r.measurements.y_unit; });
}

}  // namespace

CsvTable curves_table(const Head& head, const FitReport& report) {
  const std::string y_unit = common_y(report);
  CsvTable table = head.table({{"curve", ""},
                               {"x", common_x(report)},
                               {"y", y_unit},
                               {"lower95", y_unit},
                               {"upper95", y_unit}});
  for (const auto& result : report.fits) {
    if (!drawn(result)) continue;
    const auto& model = result.specification.model;
    const double factor =
        interval_factor(result.specification.scale, result.fit.degrees_of_freedom);
    const auto grid = fine_grid(result);
    for (double x : grid) {
      const double y = model.value(x, result.fit.values);
      const double half = factor * curve_error(model, result.fit, x);
      head.add(table, result, {"fit", cell(x), cell(y), cell(y - half), cell(y + half)});
    }
    const auto paper = paper_values(result);
    if (paper.empty() || !result.variant.is_default) continue;
    for (double x : grid) {
      head.add(table, result, {"reference", cell(x), cell(model.value(x, paper)), "", ""});
    }
  }
  return table;
}

CsvTable comparison_table(const Head& head, const FitReport& report) {
  const std::string y_unit = common_y(report);
  CsvTable table = head.table({{"x", common_x(report)},
                               {"y", y_unit},
                               {"y_se", y_unit},
                               {"reference_y", y_unit},
                               {"reference_rounding", "%"},
                               {"difference", "%"},
                               {"difference_in_standard_errors", "1"}});
  for (const auto& result : report.fits) {
    if (!drawn(result)) continue;
    const auto& model = result.specification.model;
    const auto paper = paper_values(result);
    if (paper.empty()) continue;
    for (double x : result.specification.compare_at) {
      const double ours = model.value(x, result.fit.values);
      const double error = curve_error(model, result.fit, x);
      const double theirs = model.value(x, paper);
      head.add(table, result,
               {cell(x), cell(ours), cell(error), cell(theirs),
                cell(100 * rounding_bound(result, paper, x) / theirs),
                cell(100 * (ours / theirs - 1)), cell((ours - theirs) / error)});
    }
  }
  return table;
}

}  // namespace shakebed::fitting
