#include "sweeps/store/table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "files/error.hpp"

namespace shakebed::sweeps::store {
namespace {

using files::CsvColumn;

bool contains(const std::vector<CsvColumn>& columns, const std::string& name) {
  return std::any_of(columns.begin(), columns.end(),
                     [&](const CsvColumn& column) { return column.name == name; });
}

void refuse_axis(const std::vector<CsvColumn>& axes, const std::string& quantity) {
  if (!contains(axes, quantity)) return;
  throw files::bad_input("", "an axis makes a column `" + quantity +
                                 "`, which is a measured quantity; rename it with `as`");
}

/// Names with their units, in order of first appearance.
class ColumnUnion {
 public:
  void add_unless(const std::vector<CsvColumn>& taken, const std::string& name,
                  const std::string& unit) {
    if (contains(taken, name)) return;
    if (index_.emplace(name, columns_.size()).second) columns_.push_back({name, unit});
  }
  const std::vector<CsvColumn>& columns() const { return columns_; }
  std::optional<std::size_t> find(const std::string& name) const {
    const auto found = index_.find(name);
    return found == index_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::vector<CsvColumn> columns_;
  std::map<std::string, std::size_t> index_;
};

std::string cell(double value) { return std::isfinite(value) ? files::number_text(value) : ""; }

void append_scalars(std::vector<std::string>& cells, const ColumnUnion& columns,
                    const std::vector<simulator::Scalar>& scalars) {
  const std::size_t first = cells.size();
  cells.resize(first + columns.columns().size());
  for (const auto& scalar : scalars) {
    if (const auto at = columns.find(scalar.name)) cells[first + *at] = cell(scalar.value);
  }
}

}  // namespace

files::CsvTable collected_table(const std::vector<CsvColumn>& axis_columns,
                                const std::vector<TableRow>& rows) {
  ColumnUnion point;
  ColumnUnion quantities;
  ColumnUnion scalars;
  for (const auto& row : rows) {
    for (const auto& scalar : row.point) point.add_unless(axis_columns, scalar.name, scalar.unit);
    for (const auto& quantity : row.quantities) {
      refuse_axis(axis_columns, quantity.name);
      quantities.add_unless({}, quantity.name, quantity.unit);
    }
    for (const auto& scalar : row.scalars) {
      scalars.add_unless(axis_columns, scalar.name, scalar.unit);
    }
  }

  std::vector<CsvColumn> columns = axis_columns;
  columns.insert(columns.end(), point.columns().begin(), point.columns().end());
  for (const auto& quantity : quantities.columns()) {
    columns.push_back(quantity);
    columns.push_back({quantity.name + "_se", quantity.unit});
  }
  columns.insert(columns.end(), scalars.columns().begin(), scalars.columns().end());
  for (const char* name : {"stationary", "at_rest", "replicates", "cycles"}) {
    columns.push_back({name, "1"});
  }
  columns.push_back({"reason", ""});

  files::CsvTable table(columns);
  for (const auto& row : rows) {
    std::vector<std::string> cells = row.axis_cells;
    append_scalars(cells, point, row.point);
    const std::size_t first = cells.size();
    cells.resize(first + 2 * quantities.columns().size());
    for (const auto& quantity : row.quantities) {
      const std::size_t at = first + 2 * *quantities.find(quantity.name);
      cells[at] = cell(quantity.estimate.mean);
      cells[at + 1] = cell(quantity.estimate.standard_error);
    }
    append_scalars(cells, scalars, row.scalars);
    const bool run = row.replicates > 0;
    cells.push_back(run ? cell(row.stationary_fraction) : "");
    cells.push_back(run ? cell(row.at_rest_fraction) : "");
    cells.push_back(cell(row.replicates));
    cells.push_back(cell(row.cycles));
    cells.push_back(row.reason);
    table.add_row(std::move(cells));
  }
  return table;
}

}  // namespace shakebed::sweeps::store
