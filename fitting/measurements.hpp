#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "files/csv.hpp"

namespace shakebed::fitting {

/// A filter on one column: text must be equal, numbers equal to 1e-9.
struct Filter {
  std::string column;
  std::string value;
  std::string where;  ///< place in the fit file, for error messages
};

/// Rows left out on purpose, with the reason the fit file gives.
struct Exclusion {
  std::string column;
  double from;
  double to;
  std::string because;
};

/// Which rows of a collected table enter, before any range.
struct RowChoice {
  std::vector<Filter> select;
  std::vector<Exclusion> exclude;
  /// Least fraction of a point's replicates that must be stationary.
  double minimum_stationary = 1;
};

struct DroppedRow {
  std::size_t row;  ///< in the table, from 0
  double W;         ///< NaN when the table has no W
  std::string reason;
};

/// Rows that hold a measurement of `column`, and those of the selection that do not, and why: not
/// measured, fewer stationary replicates than asked for, at rest (T_z/(m V_p^2) < 1e-6, so also
/// every bed below onset), or excluded by the fit file.
struct UsableRows {
  std::vector<std::size_t> rows;
  std::vector<DroppedRow> dropped;
};
UsableRows usable_rows(const files::CsvTable& table, const RowChoice& choice,
                       const std::string& column);

/// The rows of the selection, whatever their state.
std::vector<std::size_t> selected_rows(const files::CsvTable& table,
                                       const std::vector<Filter>& select);

struct Point {
  std::size_t row;
  double x;
  double y;
  double error;  ///< standard error of y; NaN when there is no error column
  double W;      ///< NaN when the table has no W
};

/// Points of one fit, x ascending.
struct Measurements {
  std::vector<Point> points;
  std::vector<DroppedRow> dropped;
  std::size_t outside_range = 0;
  std::string x_unit;
  std::string y_unit;
};

/// The usable rows whose `range_column` lies in [from, to], both ends included.
struct RangeLimits {
  std::string column;
  double from;
  double to;
};
Measurements read_measurements(const files::CsvTable& table, const RowChoice& choice,
                               const std::string& x, const std::string& y,
                               const std::string& y_error, const RangeLimits& range);

/// Every different combination of the values of `columns` among the selected rows, in the order
/// in which they first appear.
std::vector<std::vector<std::string>> groups(const files::CsvTable& table,
                                             const std::vector<Filter>& select,
                                             const std::vector<std::string>& columns);

}  // namespace shakebed::fitting
