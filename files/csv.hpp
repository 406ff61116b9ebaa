#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/error.hpp"

namespace shakebed::files {

struct CsvColumn {
  std::string name;  ///< "T_z_scaled"
  std::string unit;  ///< "m V_p^2"; empty for words, "1" for pure numbers
};

/// A table in memory and as a file. On disk: `# key: value` provenance lines, one header line of
/// `name [unit]` cells, then rows; numbers in shortest form that reads back to the same double;
/// a missing value is an empty cell and reads as NaN.
class CsvTable {
 public:
  CsvTable() = default;
  explicit CsvTable(std::vector<CsvColumn> columns) : columns_(std::move(columns)) {}

  std::vector<std::string> provenance;  ///< lines without the leading "# "

  const std::vector<CsvColumn>& columns() const { return columns_; }
  std::size_t rows() const { return cells_.size(); }
  bool has_column(std::string_view name) const;
  /// Throws Error(bad_input) naming the table and the nearest column when there is none.
  std::size_t column(std::string_view name) const;

  void add_row(std::vector<std::string> cells);  ///< throws when the count does not fit
  const std::string& text(std::size_t row, std::size_t column) const;
  double number(std::size_t row, std::size_t column) const;  ///< NaN for an empty cell
  std::vector<double> numbers(std::string_view column_name) const;

  std::string place(std::size_t row) const;  ///< "data.csv:7", or "table: row 3" in memory

  std::string to_text() const;
  void write(const std::filesystem::path& file) const;  ///< temporary file, fsync, rename
  static CsvTable read(const std::filesystem::path& file);

  std::string name = "table";  ///< the file it was read from, for error messages

 private:
  std::vector<CsvColumn> columns_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<std::size_t> lines_;  ///< line of each row in the file it was read from
};

/// Shortest decimal text that reads back to the same double; empty for NaN.
std::string number_text(double value);

/// For people: so many significant digits, trailing zeros dropped ("%.{digits}g").
std::string rounded_text(double value, int digits);

/// The double that the whole of `text` spells in decimal, or nothing. Out of range is nothing too.
std::optional<double> number_from_text(std::string_view text);

/// The share that "1 %" or "1%" spells, 0.01, or nothing.
std::optional<double> share_from_percent_text(std::string_view text);

}  // namespace shakebed::files
