#include "fitting/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace shakebed::fitting {
namespace {

using files::CsvTable;
using files::number_text;

/// A point of the sweep that says nothing about its curve.
bool not_run(const CsvTable& table, std::size_t row) {
  return table.has_column("replicates") && table.number(row, table.column("replicates")) == 0;
}

/// The usable points of `column` against W, and the next point of the selection under them.
struct WholeCurve {
  Curve curve;
  std::optional<double> below;
  std::vector<DroppedRow> dropped;
};

WholeCurve whole_curve(const CsvTable& table, const RowChoice& rows, const std::string& column,
                       const std::string& error_column) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto points =
      read_measurements(table, rows, "W", column, error_column, {"W", -infinity, infinity});
  WholeCurve whole;
  for (const auto& point : points.points) {
    whole.curve.W.push_back(point.x);
    whole.curve.y.push_back(point.y);
    whole.curve.error.push_back(point.error);
  }
  if (whole.curve.W.empty()) return whole;
  for (std::size_t row : selected_rows(table, rows.select)) {
    if (not_run(table, row)) continue;
    const double W = table.number(row, table.column("W"));
    if (W < whole.curve.W.front() && !(whole.below && *whole.below >= W)) whole.below = W;
  }
  whole.dropped = points.dropped;
  return whole;
}

double resolve(const RangeBound& bound, double stretch, const WholeCurve* whole,
               const SettlingRule& settling) {
  switch (bound.kind) {
    case RangeBound::Kind::number:
      return bound.number * stretch;
    case RangeBound::Kind::peak:
      return whole->curve.W[highest_point(whole->curve, whole->below)];
    case RangeBound::Kind::W_2:
      return whole->curve.W[first_settled_point(whole->curve, settling)] * stretch;
    case RangeBound::Kind::start:
      return -std::numeric_limits<double>::infinity();
    case RangeBound::Kind::end:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

RangeLimits resolve_range(const CsvTable& table, const FitSpecification& fit, const RowChoice& rows,
                          const Variant& variant) {
  const auto from_data = [](const RangeBound& bound) {
    return bound.kind == RangeBound::Kind::peak || bound.kind == RangeBound::Kind::W_2;
  };
  WholeCurve whole;
  if (from_data(fit.range.from) || from_data(fit.range.to)) {
    whole = whole_curve(table, rows, fit.peak_of, "");
  }
  return {fit.range.column, resolve(fit.range.from, variant.stretch_from, &whole, fit.settling),
          resolve(fit.range.to, variant.stretch_to, &whole, fit.settling)};
}

double weight_of(const Point& point, const Variant& variant, const std::string& error_column) {
  if (variant.weights == Weights::equal) return 1;
  if (!(point.error > 0) || !std::isfinite(point.error)) {
    throw files::bad_input(
        "", "the point at W = " + number_text(point.W) + " has " + error_column + " = " +
                (std::isnan(point.error) ? "(empty)" : number_text(point.error)) +
                "; weights from errors need a positive one: measure longer, or use "
                "`weights: equal`");
  }
  const double relative_to = variant.method == Method::log_log ? point.y : 1;
  return relative_to * relative_to / (point.error * point.error);
}

void make_fit(const CsvTable& table, const RowChoice& rows, FitResult& result) {
  const auto& specification = result.specification;
  const bool logarithms = result.variant.method == Method::log_log;
  result.range = resolve_range(table, specification, rows, result.variant);
  result.measurements = read_measurements(table, rows, specification.x, specification.y,
                                          specification.y_error, result.range);
  Observations data;
  for (const auto& point : result.measurements.points) {
    data.x.push_back(point.x);
    data.y.push_back(point.y);
    data.weights.push_back(weight_of(point, result.variant, specification.y_error));
  }
  result.weights = data.weights;
  result.fit = logarithms ? fit_log_log(data, specification.scale)
                          : fit_least_squares(specification.model, data, specification.scale);
  auto fitted = result.fit.fitted;
  if (logarithms) {
    for (double& y : data.y) y = std::log(y);
    for (double& y : fitted) y = std::log(y);
  }
  std::vector<double> residuals;
  for (std::size_t i = 0; i < data.size(); ++i) residuals.push_back(data.y[i] - fitted[i]);
  result.correlation = correlation_coefficient(data.y, fitted);
  result.criterion = information_criterion(result.fit.chi_squared, data.size(),
                                           result.fit.values.size(), specification.scale);
  result.runs = runs_test(residuals);
}

std::vector<Variant> variants(const FitSpecification& fit) {
  using Kind = RangeBound::Kind;
  const auto stretches = [&](const RangeBound& bound) {
    std::vector<double> all{1};
    if (bound.kind == Kind::number || bound.kind == Kind::W_2) {
      all.insert(all.end(), fit.range.stretch.begin(), fit.range.stretch.end());
    }
    return all;
  };
  std::vector<Variant> all;
  for (Method method : fit.methods) {
    for (Weights weights : fit.weights) {
      for (double from : stretches(fit.range.from)) {
        for (double to : stretches(fit.range.to)) {
          all.push_back({method, weights, from, to, all.empty()});
        }
      }
    }
  }
  return all;
}

/// The same fault, with the place of the entry in the fit file where it has none of its own.
files::Error placed(const files::Error& error, const DataSpecification& entry) {
  auto faults = error.faults();
  for (auto& fault : faults) {
    if (fault.where.empty()) fault.where = entry.where;
    fault.what = entry.id + ": " + fault.what;
  }
  return {error.kind(), std::move(faults)};
}

/// The entry's rows for every group of its `for_each` (one group without it), with labels.
std::vector<std::pair<RowChoice, Labels>> row_groups(const CsvTable& table,
                                                     const DataSpecification& entry) {
  std::vector<std::pair<RowChoice, Labels>> all;
  for (const auto& values : groups(table, entry.rows.select, entry.for_each)) {
    RowChoice rows = entry.rows;
    for (std::size_t k = 0; k < values.size(); ++k) {
      rows.select.push_back({entry.for_each[k], values[k], entry.where});
    }
    Labels labels;
    for (const auto& filter : rows.select) labels.emplace_back(filter.column, filter.value);
    all.emplace_back(std::move(rows), std::move(labels));
  }
  return all;
}

void run_fit(const CsvTable& table, const FitSpecification& fit, FitReport& report) {
  for (const auto& [rows, labels] : row_groups(table, fit)) {
    for (const auto& variant : variants(fit)) {
      FitResult result;
      result.specification = fit;
      result.labels = labels;
      result.variant = variant;
      try {
        make_fit(table, rows, result);
      } catch (const files::Error& error) {
        const bool stretched = variant.stretch_from != 1 || variant.stretch_to != 1;
        if (!fit.report_problems && !stretched) throw placed(error, fit);
        result.problem = error.faults().front().what;
      }
      report.fits.push_back(std::move(result));
    }
  }
}

void run_peak(const CsvTable& table, const PeakSpecification& entry, FitReport& report) {
  for (const auto& [rows, labels] : row_groups(table, entry)) {
    PeakResult result;
    result.specification = entry;
    result.labels = labels;
    result.W_unit = table.columns()[table.column("W")].unit;
    result.y_unit = table.columns()[table.column(entry.y)].unit;
    try {
      const auto whole = whole_curve(table, rows, entry.y, entry.y_error);
      result.dropped = whole.dropped;
      result.curve = whole.curve;
      result.peak = find_peak(whole.curve, whole.below, entry.rule);
      try {
        result.settling = find_settling(whole.curve, entry.settling);
      } catch (const files::Error& error) {
        result.problem = error.faults().front().what;
      }
    } catch (const files::Error& error) {
      if (!entry.report_problems) throw placed(error, entry);
      result.problem = error.faults().front().what;
    }
    report.peaks.push_back(std::move(result));
  }
}

void compare_models(std::vector<FitResult>& fits) {
  using Key = std::tuple<std::string, Method, Weights, Scale, std::vector<std::size_t>>;
  const auto key = [](const FitResult& result) {
    std::vector<std::size_t> rows;
    for (const auto& point : result.measurements.points) rows.push_back(point.row);
    std::ranges::sort(rows);
    return Key{result.specification.y, result.variant.method, result.variant.weights,
               result.specification.scale, std::move(rows)};
  };
  std::map<Key, double> best;
  for (const auto& result : fits) {
    if (!result.fitted()) continue;
    const auto [place, fresh] = best.try_emplace(key(result), result.criterion.aicc);
    if (!fresh) place->second = std::min(place->second, result.criterion.aicc);
  }
  for (auto& result : fits) {
    if (result.fitted()) result.delta_aicc = result.criterion.aicc - best.at(key(result));
  }
}

void refuse_if_nothing_was_found(const FitReport& report) {
  const bool found = std::ranges::any_of(report.fits, &FitResult::fitted) ||
                     std::ranges::any_of(report.peaks, [](const PeakResult& result) {
                       return result.peak.has_value();
                     });
  if (found || (report.fits.empty() && report.peaks.empty())) return;
  const auto refuse = [](const DataSpecification& entry, const std::string& problem) {
    throw files::failed(entry.where, "nothing in this file could be fitted to this table; first, " +
                                         entry.id + ": " + problem);
  };
  if (!report.fits.empty()) {
    refuse(report.fits.front().specification, report.fits.front().problem);
  }
  refuse(report.peaks.front().specification, report.peaks.front().problem);
}

}  // namespace

std::string Variant::text() const {
  if (is_default) return "default";
  std::string text = method == Method::log_log ? "log_log" : "linear";
  text += weights == Weights::equal ? " equal" : " errors";
  if (stretch_from != 1) text += " from x" + number_text(stretch_from);
  if (stretch_to != 1) text += " to x" + number_text(stretch_to);
  return text;
}

FitReport run_fits(const FitFile& file, const CsvTable& table) {
  FitReport report;
  for (const auto& fit : file.fits) run_fit(table, fit, report);
  for (const auto& peak : file.peaks) run_peak(table, peak, report);
  refuse_if_nothing_was_found(report);
  compare_models(report.fits);
  return report;
}

}  // namespace shakebed::fitting
