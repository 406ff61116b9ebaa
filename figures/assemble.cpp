#include "figures/assemble.hpp"

#include <algorithm>
#include <cmath>

#include "files/error.hpp"

namespace shakebed::figures {
namespace {

using files::CsvColumn;
using files::CsvTable;

bool same_header(const CsvTable& a, const CsvTable& b) {
  return std::equal(a.columns().begin(), a.columns().end(), b.columns().begin(), b.columns().end(),
                    [](const CsvColumn& left, const CsvColumn& right) {
                      return left.name == right.name && left.unit == right.unit;
                    });
}

void append_rows(CsvTable& target, const CsvTable& more) {
  for (std::size_t row = 0; row < more.rows(); ++row) {
    std::vector<std::string> cells;
    for (std::size_t column = 0; column < more.columns().size(); ++column) {
      cells.push_back(more.text(row, column));
    }
    target.add_row(std::move(cells));
  }
}

const CsvTable& table_named(const std::string& name, const Part& part, const Tables& tables) {
  const auto found = tables.find(name);
  if (found != tables.end()) return found->second;
  throw files::bad_input(part.where, "part '" + part.name + "' needs the table '" + name +
                                         "'; give it with --table " + name + "=FILE");
}

CsvTable stacked(const NamedTables& source, const Part& part, const Tables& tables) {
  CsvTable all = table_named(source.names.front(), part, tables);
  for (std::size_t i = 1; i < source.names.size(); ++i) {
    const auto& next = table_named(source.names[i], part, tables);
    if (!same_header(all, next)) {
      throw files::bad_input(part.where, "tables '" + source.names.front() + "' and '" +
                                             source.names[i] +
                                             "' have different columns and cannot be stacked");
    }
    for (const auto& line : next.provenance) {
      const auto& known = all.provenance;
      if (std::find(known.begin(), known.end(), line) == known.end()) {
        all.provenance.push_back(line);
      }
    }
    append_rows(all, next);
  }
  return all;
}

CsvTable source_table(const Part& part, const Tables& tables) {
  if (const auto* named = std::get_if<NamedTables>(&part.source)) {
    return stacked(*named, part, tables);
  }
  return CsvTable::read(std::get<TableFile>(part.source).file);
}

std::size_t column_for(const CsvTable& table, const std::string& name, const std::string& where) {
  try {
    return table.column(name);
  } catch (const files::Error& error) {
    throw files::bad_input(where, error.faults().front().what);
  }
}

std::vector<std::size_t> picked_rows(const CsvTable& table, const Part& part) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) rows.push_back(row);
  for (const auto& filter : part.filters) {
    const auto column = column_for(table, filter.column, filter.where);
    std::erase_if(rows, [&](std::size_t row) {
      return std::find(filter.words.begin(), filter.words.end(), table.text(row, column)) ==
             filter.words.end();
    });
    if (rows.empty()) {
      throw files::bad_input(filter.where, "no row of '" + table.name +
                                               "' is left after picking '" + filter.column +
                                               "'; check the words as written there");
    }
  }
  return rows;
}

/// Where the cells of one column of the part come from.
struct CellSource {
  CsvColumn header;
  std::size_t column = 0;   ///< copied, or the fraction that is stationary
  std::size_t at_rest = 0;  ///< only for a state
  bool is_state = false;

  std::string cell(const CsvTable& table, std::size_t row) const {
    if (!is_state) return table.text(row, column);
    return state_of_point(table.number(row, column), table.number(row, at_rest));
  }
};

CellSource cell_source(const PartColumn& wanted, const CsvTable& table) {
  if (const auto* copied = std::get_if<CopiedColumn>(&wanted.kind)) {
    const auto column = column_for(table, copied->column, wanted.where);
    return {{copied->as, table.columns()[column].unit}, column};
  }
  const auto& state = std::get<StateColumn>(wanted.kind);
  return {{state.as, ""},
          column_for(table, state.stationary, wanted.where),
          column_for(table, state.at_rest, wanted.where),
          true};
}

}  // namespace

std::string state_of_point(double stationary, double at_rest) {
  if (std::isnan(stationary) || std::isnan(at_rest)) return "missing";
  if (at_rest == 1) return "at rest";
  if (at_rest > 0) return "not stationary";
  return stationary < 1 ? "not stationary" : "steady";
}

CsvTable assemble(const Part& part, const Tables& tables) {
  const auto source = source_table(part, tables);
  const auto rows = picked_rows(source, part);
  std::vector<CellSource> cells;
  if (part.columns.empty()) {
    for (std::size_t i = 0; i < source.columns().size(); ++i) {
      cells.push_back({source.columns()[i], i});
    }
  }
  for (const auto& column : part.columns) cells.push_back(cell_source(column, source));

  std::vector<CsvColumn> header;
  for (const auto& cell : cells) header.push_back(cell.header);
  CsvTable table(header);
  table.name = part.name;
  table.provenance = source.provenance;
  for (const auto row : rows) {
    std::vector<std::string> line;
    for (const auto& cell : cells) line.push_back(cell.cell(source, row));
    table.add_row(std::move(line));
  }
  return table;
}

}  // namespace shakebed::figures
