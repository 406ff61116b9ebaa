#include "sweeps/column_table.hpp"

#include <cmath>
#include <cstdio>

#include "files/error.hpp"
#include "simulator/observables/column_series.hpp"
#include "sweeps/cached_runs.hpp"

namespace shakebed::sweeps {
namespace {

using simulator::ColumnSeries;
using simulator::Record;
using simulator::Series;

std::string seven_digits(double value) {
  if (!std::isfinite(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return text;
}

const Series* series_of(const Record& record, const std::string& name) {
  for (const auto& series : record.series) {
    if (series.name == name) return &series;
  }
  return nullptr;
}

std::vector<files::CsvColumn> series_columns() {
  std::vector<files::CsvColumn> columns;
  for (std::size_t c = 0; c < ColumnSeries::columns; ++c) {
    const auto column = static_cast<ColumnSeries::Column>(c);
    columns.push_back({ColumnSeries::name(column), ColumnSeries::unit(column)});
  }
  return columns;
}

/// Samples a run made in each cycle, and which of them the table takes.
long stride(const Record& record, const SeriesChoice& choice, const std::string& sweep) {
  const long recorded = std::lround(1 / record.series.front().cycles_per_entry);
  if (choice.phases < 1 || recorded % choice.phases != 0) {
    throw files::bad_input(sweep, "its runs recorded " + std::to_string(recorded) +
                                      " phases a cycle; expected a divisor of that, got " +
                                      std::to_string(choice.phases));
  }
  return recorded / choice.phases;
}

void add_rows(files::CsvTable& table, const std::vector<std::string>& point_cells,
              const Record& record, const SeriesChoice& choice, const std::string& sweep) {
  const long every = stride(record, choice, sweep);
  const double per_entry = record.series.front().cycles_per_entry;
  std::vector<const Series*> all;
  for (const auto& column : series_columns()) all.push_back(series_of(record, column.name));
  const Series* large = all[ColumnSeries::large_height];
  const Series* small = all[ColumnSeries::small_height];
  for (std::size_t k = 0; k < small->values.size(); k += static_cast<std::size_t>(every)) {
    const double T = static_cast<double>(k) * per_entry;
    if (T < choice.from || T > choice.to) continue;
    auto cells = point_cells;
    cells.push_back(seven_digits(T));
    cells.push_back(seven_digits(T - std::floor(T)));
    cells.push_back(large == nullptr ? "" : seven_digits(large->values[k] - small->values[k]));
    for (const Series* series : all) {
      cells.push_back(series == nullptr ? "" : seven_digits(series->values[k]));
    }
    table.add_row(std::move(cells));
  }
}

}  // namespace

Collected collect_series(const Grid& grid, const store::Cache& cache, const SeriesChoice& choice) {
  Collected collected;
  CachedRuns runs(grid, cache);
  auto columns = grid.columns;
  columns.insert(
      columns.end(),
      {{"replicate", "1"}, {"T", "cycles"}, {"phase", "cycles"}, {"large_over_centre", "d"}});
  for (auto& column : series_columns()) columns.push_back(std::move(column));
  files::CsvTable table(std::move(columns));
  for (std::size_t k = 0; k < runs.points(); ++k) {
    if (!runs.point(k).scene.column) {
      throw files::bad_input(grid.id,
                             "only beds in a container have series within a cycle; a point of this "
                             "sweep has none: " +
                                 grid.describe(runs.point(k)));
    }
    const auto records = runs.records(k, collected);
    for (std::size_t r = 0; r < records.size(); ++r) {
      auto cells = runs.point(k).labels;
      cells.push_back(std::to_string(r + 1));
      add_rows(table, cells, records[r], choice, grid.id);
    }
  }
  collected.table = std::move(table);
  collected.table.provenance = runs.provenance(collected);
  return collected;
}

}  // namespace shakebed::sweeps
