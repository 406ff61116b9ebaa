#include "fitting/tables/head.hpp"

namespace shakebed::fitting {

using files::CsvTable;

CsvTable collapse_table(const Head& head, const FitReport& report) {
  CsvTable table = head.table({{"W", "1"},
                               {"W_over_W_f", "1"},
                               {"y", ""},
                               {"y_se", ""},
                               {"y_over_peak", "1"},
                               {"y_over_peak_se", "1"}});
  for (const auto& result : report.peaks) {
    if (!result.peak) continue;
    const double W_f = result.peak->W_f.value;
    const double height = result.peak->height.value;
    for (std::size_t i = 0; i < result.curve.W.size(); ++i) {
      head.add(table, result,
               {cell(result.curve.W[i]), cell(result.curve.W[i] / W_f), cell(result.curve.y[i]),
                cell(result.curve.error[i]), cell(result.curve.y[i] / height),
                cell(result.curve.error[i] / height)});
    }
  }
  return table;
}

namespace {

std::string unit_of_ratio(const std::string& of, const std::string& over) {
  if (of == over) return "1";
  return over == "1" ? of : of + "/(" + over + ")";
}

/// The columns that say which row this is: all before the first measured one, and its state.
std::vector<std::size_t> naming_columns(const CsvTable& data) {
  std::vector<std::size_t> named;
  const auto& columns = data.columns();
  for (std::size_t k = 0; k < columns.size() && !data.has_column(columns[k].name + "_se"); ++k) {
    named.push_back(k);
  }
  for (const char* state : {"stationary", "at_rest", "reason"}) {
    if (data.has_column(state)) named.push_back(data.column(state));
  }
  return named;
}

/// The row to compare `row` with; none when the table has no such row.
std::optional<std::size_t> row_against(const CsvTable& data, const RatioSpecification& ratio,
                                       std::size_t row) {
  if (ratio.against.empty()) return row;
  for (const std::size_t other : selected_rows(data, ratio.against)) {
    const bool same = std::ranges::all_of(ratio.match, [&](const std::string& name) {
      return data.text(row, data.column(name)) == data.text(other, data.column(name));
    });
    if (same) return other;
  }
  return std::nullopt;
}

/// Value and standard error as cells; empty where either number is missing, and 1 +- 0 of a row
/// over itself.
std::pair<std::string, std::string> ratio_cells(const CsvTable& data,
                                                const RatioSpecification& ratio, std::size_t row) {
  const auto other = row_against(data, ratio, row);
  if (!other) return {"", ""};
  if (*other == row && ratio.of == ratio.over) return {"1", "0"};
  const auto number = [&](std::size_t at, const std::string& name) {
    return data.number(at, data.column(name));
  };
  const double above = number(row, ratio.of);
  const double below = number(*other, ratio.over);
  const double relative =
      std::hypot(number(row, ratio.of + "_se") / above, number(*other, ratio.over + "_se") / below);
  return {cell(above / below), cell(std::abs(above / below) * relative)};
}

}  // namespace

/// Relative errors add in quadrature; two columns of one bed are correlated, which this leaves out.
CsvTable ratios_table(const FitFile& file, const CsvTable& data) {
  const auto named = naming_columns(data);
  std::vector<files::CsvColumn> columns;
  for (const std::size_t k : named) columns.push_back(data.columns()[k]);
  for (const auto& ratio : file.ratios) {
    const auto unit = unit_of_ratio(data.columns()[data.column(ratio.of)].unit,
                                    data.columns()[data.column(ratio.over)].unit);
    columns.push_back({ratio.id, unit});
    columns.push_back({ratio.id + "_se", unit});
  }
  CsvTable table(std::move(columns));
  if (file.ratios.empty()) return table;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    Cells cells;
    for (const std::size_t k : named) cells.push_back(data.text(row, k));
    for (const auto& ratio : file.ratios) {
      const auto [value, error] = ratio_cells(data, ratio, row);
      cells.push_back(value);
      cells.push_back(error);
    }
    table.add_row(std::move(cells));
  }
  return table;
}

}  // namespace shakebed::fitting
