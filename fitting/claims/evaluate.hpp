#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/csv.hpp"
#include "fitting/claims/formula.hpp"

namespace shakebed::fitting::claims {

/// Evaluates a formula over tables, once with their numbers as they are, then with each number that
/// has a standard error redrawn: x + s N(0, 1), the same draw wherever the cell is used. A column's
/// error stands in the column <name>_se, for a fit's `value` in `standard_error`; other columns are
/// taken as exact. Which rows are looked at never depends on the draws.
class Evaluation {
 public:
  /// Under the name that formulas use; the first table is the one that plain columns belong to.
  using Tables = std::vector<std::pair<std::string, const files::CsvTable*>>;
  /// `steady_only`: rows of points that are at rest or not stationary are left out.
  Evaluation(Tables tables, bool steady_only);

  /// One number; throws Error(failed) when there is none (no such row, empty cell, several cells).
  double number(const Formula& formula);
  /// What `each` left out, because the formula has no number there, and why.
  const std::vector<std::string>& left_out() const { return left_out_; }
  /// Redraws every cell used so far; `normal` gives N(0, 1).
  void redraw(const std::function<double()>& normal);

 private:
  using Rows = std::vector<std::vector<std::size_t>>;  ///< of each table
  using Values = std::vector<double>;
  struct Cell {
    double mean;
    double error;
    double drawn;
  };
  struct Place {
    std::size_t table;
    std::size_t column;
  };

  double one_number(const Formula& formula, const Rows& rows);
  Values values(const Formula& formula, const Rows& rows);
  Values column(const std::string& name, const Rows& rows);
  Values each(const Formula& formula, const Rows& rows);
  const Rows& narrowed(const Formula& formula, const Rows& rows);
  Place place_of(const std::string& name) const;
  const Cell& cell(Place place, std::size_t row);
  std::vector<std::size_t> tables_with(const std::string& column) const;
  std::size_t column_in(std::size_t table, const std::string& name) const;

  Tables tables_;
  Rows all_;
  std::map<std::pair<const Formula*, Rows>, Rows> narrowed_;
  std::map<std::pair<const Formula*, Rows>, std::vector<Rows>> groups_;
  std::unordered_map<std::uint64_t, std::size_t> cell_index_;
  std::vector<Cell> cells_;
  std::vector<std::string> left_out_;
};

}  // namespace shakebed::fitting::claims
