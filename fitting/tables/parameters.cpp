#include "fitting/tables/head.hpp"

namespace shakebed::fitting {

using files::CsvTable;

namespace {

void add_parameters(const Head& head, const FitResult& result, CsvTable& table) {
  const auto& specification = result.specification;
  const auto& measurements = result.measurements;
  const auto& fit = result.fit;
  const auto& model = specification.model;
  const auto units = model.units(measurements.x_unit, measurements.y_unit);
  for (std::size_t k = 0; k < fit.values.size(); ++k) {
    const auto printed = specification.reference.parameters.find(model.parameters[k]);
    const bool known = printed != specification.reference.parameters.end();
    const double paper = known ? printed->second.value : unknown;
    const double error = fit.standard_error(k);
    const bool study = k == model.nonlinear;
    head.add(
        table, result,
        {model.parameters[k], cell(fit.values[k]), cell(error), cell(fit.intervals[k].lower),
         cell(fit.intervals[k].upper), units[k], cell(paper),
         cell(known ? printed->second.half_unit : unknown), cell(100 * (fit.values[k] / paper - 1)),
         cell((fit.values[k] - paper) / error), study ? cell(specification.reference.reported) : "",
         study ? cell(specification.reference.reported_error) : ""});
  }
}

double largest_correlation(const LeastSquaresFit& fit) {
  double largest = 0;
  for (std::size_t i = 0; i < fit.values.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest = std::max(largest, std::abs(fit.correlation(i, j)));
    }
  }
  return largest;
}

void add_summary(const Head& head, const FitResult& result, CsvTable& table) {
  const auto& specification = result.specification;
  const auto& points = result.measurements.points;
  const bool logarithms = result.variant.method == Method::log_log;
  Cells cells{logarithms ? "log_log" : "linear",
              result.variant.weights == Weights::equal ? "equal" : "errors",
              specification.scale == Scale::estimated ? "scaled" : "given",
              logarithms ? "exact" : "profile likelihood",
              specification.x,
              specification.y,
              specification.range.column,
              cell(result.range.from),
              cell(result.range.to),
              specification.range.certain ? "given" : "uncertain",
              points.empty() ? "" : cell(points.front().x),
              points.empty() ? "" : cell(points.back().x),
              cell(points.size()),
              cell(result.measurements.dropped.size()),
              cell(result.measurements.outside_range)};
  if (result.fitted()) {
    const auto& fit = result.fit;
    cells.insert(cells.end(),
                 {cell(fit.chi_squared), cell(fit.degrees_of_freedom),
                  cell(fit.chi_squared / double(fit.degrees_of_freedom)), cell(result.correlation),
                  cell(specification.reference.correlation), cell(result.criterion.aic),
                  cell(result.criterion.aicc), cell(result.delta_aicc), cell(result.runs.runs),
                  cell(result.runs.expected_runs), cell(result.runs.p_value),
                  cell(largest_correlation(fit)), specification.reference.source, ""});
  } else {
    cells.resize(cells.size() + 13);
    cells.push_back(result.problem);
  }
  head.add(table, result, std::move(cells));
}

}  // namespace

CsvTable parameters_table(const Head& head, const FitReport& report) {
  CsvTable table = head.table({{"parameter", ""},
                               {"value", ""},
                               {"standard_error", ""},
                               {"lower95", ""},
                               {"upper95", ""},
                               {"unit", ""},
                               {"reference", ""},
                               {"reference_half_unit", ""},
                               {"difference", "%"},
                               {"difference_in_standard_errors", "1"},
                               {"reported", ""},
                               {"reported_error", ""}});
  for (const auto& result : report.fits) {
    if (result.fitted()) add_parameters(head, result, table);
  }
  for (const auto& result : report.peaks) {
    const auto add = [&](const std::string& name, const BootstrapEstimate& estimate,
                         const std::string& unit) {
      head.add(
          table, result,
          {name, cell(estimate.value), cell(estimate.standard_error), cell(estimate.interval.lower),
           cell(estimate.interval.upper), unit, "", "", "", "", "", ""});
    };
    if (result.peak) {
      add("W_f", result.peak->W_f, result.W_unit);
      add("peak_height", result.peak->height, result.y_unit);
    }
    if (result.settling) add("W_2", result.settling->W_2, result.W_unit);
  }
  return table;
}

CsvTable summary_table(const Head& head, const FitReport& report) {
  CsvTable table = head.table({{"method", ""},
                               {"weights", ""},
                               {"covariance", ""},
                               {"intervals", ""},
                               {"x", ""},
                               {"y", ""},
                               {"range_column", ""},
                               {"from", ""},
                               {"to", ""},
                               {"range_known", ""},
                               {"first_x", ""},
                               {"last_x", ""},
                               {"points", "1"},
                               {"dropped", "1"},
                               {"outside_range", "1"},
                               {"chi_squared", "1"},
                               {"degrees_of_freedom", "1"},
                               {"chi_squared_per_dof", "1"},
                               {"correlation", "1"},
                               {"reference_correlation", "1"},
                               {"aic", "1"},
                               {"aicc", "1"},
                               {"delta_aicc", "1"},
                               {"runs", "1"},
                               {"expected_runs", "1"},
                               {"runs_p", "1"},
                               {"largest_parameter_correlation", "1"},
                               {"reference_source", ""},
                               {"problem", ""}});
  for (const auto& result : report.fits) add_summary(head, result, table);
  return table;
}

CsvTable correlations_table(const Head& head, const FitReport& report) {
  CsvTable table = head.table({{"parameter_1", ""}, {"parameter_2", ""}, {"correlation", "1"}});
  for (const auto& result : report.fits) {
    if (!result.fitted()) continue;
    const auto& names = result.specification.model.parameters;
    for (std::size_t i = 0; i < names.size(); ++i) {
      for (std::size_t j = i + 1; j < names.size(); ++j) {
        head.add(table, result, {names[i], names[j], cell(result.fit.correlation(i, j))});
      }
    }
  }
  return table;
}

CsvTable points_table(const Head& head, const FitReport& report) {
  CsvTable table = head.table({{"W", "1"},
                               {"x", ""},
                               {"y", ""},
                               {"y_se", ""},
                               {"fitted", ""},
                               {"residual", ""},
                               {"residual_in_errors", "1"},
                               {"dropped_because", ""}});
  for (const auto& result : report.fits) {
    if (!result.fitted() || !result.variant.is_default) continue;
    for (std::size_t i = 0; i < result.measurements.points.size(); ++i) {
      const Point& point = result.measurements.points[i];
      const double residual = point.y - result.fit.fitted[i];
      head.add(table, result,
               {cell(point.W), cell(point.x), cell(point.y), cell(point.error),
                cell(result.fit.fitted[i]), cell(residual), cell(residual / point.error), ""});
    }
    for (const auto& row : result.measurements.dropped) {
      head.add(table, result, {cell(row.W), "", "", "", "", "", "", row.reason});
    }
  }
  return table;
}

}  // namespace shakebed::fitting
