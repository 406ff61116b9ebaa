#include <cstdarg>
#include <cstdio>
#include <set>

#include "fitting/exponents.hpp"
#include "fitting/tables/head.hpp"

namespace shakebed::fitting {
namespace {

[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string labels_text(const Labels& labels) {
  std::string text;
  for (const auto& [column, value] : labels) {
    text += (text.empty() ? "" : ", ") + (column == "system" ? value : column + " = " + value);
  }
  return text;
}

std::string parameter_line(const FitResult& result, std::size_t k) {
  const auto& specification = result.specification;
  const auto& fit = result.fit;
  const auto& name = specification.model.parameters[k];
  std::string line =
      formatted("  %-6s %10.4g +- %-9.2g [%9.4g, %9.4g]", name.c_str(), fit.values[k],
                fit.standard_error(k), fit.intervals[k].lower, fit.intervals[k].upper);
  const auto printed = specification.reference.parameters.find(name);
  if (printed != specification.reference.parameters.end()) {
    const double paper = printed->second.value;
    line +=
        formatted("   paper %-7.4g %+6.1f %% %+6.1f se", paper, 100 * (fit.values[k] / paper - 1),
                  (fit.values[k] - paper) / fit.standard_error(k));
  }
  return line + "\n";
}

std::string fit_text(const FitResult& result) {
  const auto& specification = result.specification;
  const auto& points = result.measurements.points;
  std::string text =
      specification.id + ": " + specification.y + " against " + specification.x + ", " +
      labels_text(result.labels) + ", " + specification.model.name + ", " +
      (result.variant.method == Method::log_log ? "log-log, " : "") +
      (result.variant.weights == Weights::equal ? "equal weights" : "weights from errors") + "\n";
  if (!result.fitted()) return text + "  not fitted: " + result.problem + "\n";
  text += formatted("  %zu points, %s %.4g to %.4g", points.size(), specification.x.c_str(),
                    points.front().x, points.back().x);
  text +=
      formatted("; chi^2/dof %.3g; correlation %.4f",
                result.fit.chi_squared / double(result.fit.degrees_of_freedom), result.correlation);
  if (specification.reference.correlation) {
    text += formatted(" (paper %.4f)", *specification.reference.correlation);
  }
  text += formatted("; AICc +%.1f; %zu runs, %.1f expected, p = %.2g\n",
                    result.delta_aicc.value_or(unknown), result.runs.runs,
                    result.runs.expected_runs, result.runs.p_value);
  for (std::size_t k = 0; k < result.fit.values.size(); ++k) text += parameter_line(result, k);
  return text;
}

std::string exponents_text(const FitReport& report) {
  std::string text;
  for (const auto& [result, methods, ranges, all, variants, W, error] : exponents(report)) {
    const auto& specification = result->specification;
    const auto& fit = result->fit;
    const std::size_t k = specification.model.nonlinear;
    text += formatted(
        "%-34s %-10s %6.3f +- %.3f (scatter %.3f)  methods %.3f..%.3f  ranges %.3f..%.3f  %s "
        "[%.3g, %.3g]%s, "
        "%zu points W %.3g..%.3g",
        specification.id.c_str(), labels_text(result->labels).c_str(), fit.values[k], error,
        fit.standard_error(k), methods.low, methods.high, ranges.low, ranges.high,
        specification.range.column.c_str(), result->range.from, result->range.to,
        specification.range.certain ? "" : " (uncertain)", result->measurements.points.size(),
        W.low, W.high);
    const auto printed = specification.reference.parameters.find("alpha");
    if (printed != specification.reference.parameters.end()) {
      text += formatted("  paper %.4g", printed->second.value);
    }
    if (specification.reference.reported) {
      text += formatted("  study %.4g", *specification.reference.reported);
    }
    text += "\n";
  }
  return text.empty() ? text : "Exponents (default rule +- standard error, spreads):\n" + text;
}

std::string estimate_text(const char* name, const BootstrapEstimate& estimate) {
  return formatted("  %-12s %8.4g +- %-8.2g [%8.4g, %8.4g]\n", name, estimate.value,
                   estimate.standard_error, estimate.interval.lower, estimate.interval.upper);
}

std::string peak_text(const PeakResult& result) {
  std::string text = result.specification.id + ": peak of " + result.specification.y + ", " +
                     labels_text(result.labels) + "\n";
  if (result.peak) {
    text += estimate_text("W_f", result.peak->W_f);
    if (!result.peak->refined) text += "  (the grid point, bounded by its neighbours)\n";
    text += estimate_text("peak height", result.peak->height);
  }
  if (result.settling) text += estimate_text("W_2", result.settling->W_2);
  if (!result.problem.empty()) text += "  " + result.problem + "\n";
  return text;
}

/// Each dropped row once, by selection.
std::string dropped_text(const FitReport& report) {
  std::set<std::string> lines;
  const auto collect = [&](const Labels& labels, const std::vector<DroppedRow>& dropped) {
    for (const auto& row : dropped) {
      lines.insert("  " + labels_text(labels) + formatted(", W = %.4g: ", row.W) + row.reason +
                   "\n");
    }
  };
  for (const auto& result : report.fits) collect(result.labels, result.measurements.dropped);
  for (const auto& result : report.peaks) collect(result.labels, result.dropped);
  std::string text;
  for (const auto& line : lines) text += line;
  return text.empty() ? text : "Left out:\n" + text;
}

}  // namespace

std::string readable(const FitReport& report) {
  std::string text;
  for (const auto& result : report.fits) {
    const bool exponent = result.specification.model.name == "power_law";
    const bool stretched = result.variant.stretch_from != 1 || result.variant.stretch_to != 1;
    const bool told_below = exponent && (result.fitted() || !result.variant.is_default);
    if (!stretched && !told_below) text += fit_text(result);
  }
  text += exponents_text(report);
  for (const auto& result : report.peaks) text += peak_text(result);
  return text + dropped_text(report);
}

}  // namespace shakebed::fitting
