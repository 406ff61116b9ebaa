#include "fitting/measurements.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <set>

namespace shakebed::fitting {
namespace {

using files::CsvTable;
using files::number_text;

/// Below this T_z/(m V_p^2) a vertically shaken bed under gravity is at rest.
constexpr double rest_temperature = 1e-6;

std::optional<double> as_number(const std::string& text) {
  if (text.empty()) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size()) return std::nullopt;
  return value;
}

bool matches(const std::string& cell, const std::string& wanted) {
  if (cell == wanted) return true;
  const auto a = as_number(cell);
  const auto b = as_number(wanted);
  return a && b && std::abs(*a - *b) <= 1e-9 * std::max(std::abs(*a), std::abs(*b));
}

std::string values_of(const CsvTable& table, std::size_t column) {
  std::set<std::string> values;
  for (std::size_t row = 0; row < table.rows(); ++row) values.insert(table.text(row, column));
  std::string list;
  std::size_t shown = 0;
  for (const auto& value : values) {
    if (++shown > 12) return list + ", ...";
    list += (list.empty() ? "" : ", ") + value;
  }
  return list;
}

double W_of(const CsvTable& table, std::size_t row) {
  return table.has_column("W") ? table.number(row, table.column("W"))
                               : std::numeric_limits<double>::quiet_NaN();
}

/// Why this row cannot enter; empty when it can.
std::string fault_of(const CsvTable& table, const RowChoice& choice, std::size_t row,
                     std::size_t column) {
  if (table.number(row, table.column("at_rest")) > 0) return "at rest";
  if (table.has_column("T_z_scaled") &&
      table.number(row, table.column("T_z_scaled")) < rest_temperature) {
    return "below onset (T_z_scaled < 1e-6)";
  }
  if (!std::isfinite(table.number(row, column))) return "not measured";
  const double stationary = table.number(row, table.column("stationary"));
  if (!(stationary >= choice.minimum_stationary)) {
    return "stationary in " + number_text(stationary) + " of its replicates, asked for " +
           number_text(choice.minimum_stationary);
  }
  for (const auto& exclusion : choice.exclude) {
    const double value = table.number(row, table.column(exclusion.column));
    if (value >= exclusion.from && value <= exclusion.to) return exclusion.because;
  }
  return {};
}

}  // namespace

std::vector<std::size_t> selected_rows(const CsvTable& table, const std::vector<Filter>& select) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const bool wanted = std::ranges::all_of(select, [&](const Filter& filter) {
      return matches(table.text(row, table.column(filter.column)), filter.value);
    });
    if (wanted) rows.push_back(row);
  }
  if (!rows.empty()) return rows;
  if (select.empty()) throw files::bad_input(table.name, "the table has no rows");
  std::string what = "no row of " + table.name + " has";
  for (const auto& filter : select) {
    what += (filter.column == select.front().column ? " " : " and ") + filter.column + " = " +
            filter.value + " (it holds " + values_of(table, table.column(filter.column)) + ")";
  }
  throw files::bad_input(select.front().where, what);
}

UsableRows usable_rows(const CsvTable& table, const RowChoice& choice, const std::string& column) {
  UsableRows usable;
  const std::size_t y = table.column(column);
  for (std::size_t row : selected_rows(table, choice.select)) {
    const std::string fault = fault_of(table, choice, row, y);
    if (fault.empty()) {
      usable.rows.push_back(row);
    } else {
      usable.dropped.push_back({row, W_of(table, row), fault});
    }
  }
  return usable;
}

Measurements read_measurements(const CsvTable& table, const RowChoice& choice, const std::string& x,
                               const std::string& y, const std::string& y_error,
                               const RangeLimits& range) {
  const std::size_t x_column = table.column(x);
  const std::size_t y_column = table.column(y);
  const std::size_t range_column = table.column(range.column);
  Measurements measurements;
  measurements.x_unit = table.columns()[x_column].unit;
  measurements.y_unit = table.columns()[y_column].unit;
  auto usable = usable_rows(table, choice, y);
  measurements.dropped = std::move(usable.dropped);
  for (std::size_t row : usable.rows) {
    const double position = table.number(row, range_column);
    if (!(position >= range.from && position <= range.to)) {
      ++measurements.outside_range;
      continue;
    }
    const double error = y_error.empty() ? std::numeric_limits<double>::quiet_NaN()
                                         : table.number(row, table.column(y_error));
    measurements.points.push_back(
        {row, table.number(row, x_column), table.number(row, y_column), error, W_of(table, row)});
  }
  std::ranges::stable_sort(measurements.points, {}, &Point::x);
  return measurements;
}

std::vector<std::vector<std::string>> groups(const CsvTable& table,
                                             const std::vector<Filter>& select,
                                             const std::vector<std::string>& columns) {
  std::vector<std::vector<std::string>> found;
  for (std::size_t row : selected_rows(table, select)) {
    std::vector<std::string> values;
    for (const auto& column : columns) values.push_back(table.text(row, table.column(column)));
    if (std::ranges::find(found, values) == found.end()) found.push_back(values);
  }
  return found;
}

}  // namespace shakebed::fitting
