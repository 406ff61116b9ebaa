#include <cmath>

#include "files/csv.hpp"
#include "files/error.hpp"
#include "fitting/networks/snapshot.hpp"

namespace shakebed::fitting::networks {

namespace {

/// "12", and "12.0" too: tables with empty cells often come back with ids as decimals.
std::int64_t id_cell(const files::CsvTable& table, std::size_t row, std::size_t column) {
  constexpr double largest_exact = 9007199254740992.0;  // 2^53
  const double value = table.number(row, column);
  if (std::isnan(value) || value != std::floor(value) || std::abs(value) > largest_exact) {
    throw files::bad_input(table.place(row), "column `" + table.columns()[column].name +
                                                 "`: expected the id of a grain (an integer up to "
                                                 "2^53 in size), got `" +
                                                 table.text(row, column) + "`");
  }
  return static_cast<std::int64_t>(value);
}

std::vector<GrainRow> grain_rows(const files::CsvTable& table) {
  const std::size_t id = table.column("id"), radius = table.column("radius");
  const std::size_t x = table.column("x"), y = table.column("y"), z = table.column("z");
  std::vector<GrainRow> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    rows.push_back({id_cell(table, row, id),
                    {table.number(row, x), table.number(row, y), table.number(row, z)},
                    table.number(row, radius)});
  }
  return rows;
}

std::vector<ContactRow> contact_rows(const files::CsvTable& table) {
  const std::size_t i = table.column("i"), j = table.column("j");
  const std::size_t force = table.column("normal_force");
  std::vector<ContactRow> rows;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::optional<std::int64_t> other;
    if (!table.text(row, j).empty()) other = id_cell(table, row, j);
    rows.push_back({id_cell(table, row, i), other, table.number(row, force)});
  }
  return rows;
}

}  // namespace

Snapshot read_snapshot_csv(const std::filesystem::path& grains,
                           const std::filesystem::path& contacts) {
  const auto grain_table = files::CsvTable::read(grains);
  const auto contact_table = files::CsvTable::read(contacts);
  const auto grain_list = grain_rows(grain_table);
  const auto contact_list = contact_rows(contact_table);
  return assemble(
      grains.string(), grain_list, [&](std::size_t row) { return grain_table.place(row); },
      contact_list, [&](std::size_t row) { return contact_table.place(row); });
}

}  // namespace shakebed::fitting::networks
