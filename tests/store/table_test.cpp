#include "sweeps/store/table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

namespace shakebed::tests {
namespace {

using sweeps::store::collected_table;
using sweeps::store::TableRow;

TEST_CASE("Columns are the union of the rows', in order; what a row lacks is empty") {
  TableRow flat;
  flat.axis_cells = {"2D smooth", "300"};
  flat.point = {{"W", "1", 0.5}, {"Gamma", "1", INFINITY}};
  flat.quantities = {{"T_z", "m g d", {2, 0.5}}, {"T_x", "m g d", {1, NAN}}};
  flat.scalars = {{"k_n", "m g/d", 2e5}};
  flat.replicates = 2;
  flat.stationary_fraction = 0.5;
  flat.cycles = 600;
  TableRow deep = flat;
  deep.axis_cells = {"3D smooth", "300"};
  deep.quantities = {{"T_z", "m g d", {3, 0.25}}, {"T_y", "m g d", {4, 0.125}}};
  deep.reason = "not stationary: one plug";
  TableRow missing;
  missing.axis_cells = {"3D rough", "300"};
  missing.point = flat.point;

  const auto table =
      collected_table({{"system", ""}, {"frequency_rpm", "rpm"}}, {flat, deep, missing});
  std::string header;
  for (const auto& column : table.columns()) {
    header += column.name + "[" + column.unit + "] ";
  }
  CHECK(header ==
        "system[] frequency_rpm[rpm] W[1] Gamma[1] T_z[m g d] T_z_se[m g d] T_x[m g d] "
        "T_x_se[m g d] T_y[m g d] T_y_se[m g d] k_n[m g/d] stationary[1] at_rest[1] "
        "replicates[1] cycles[1] reason[] ");
  CHECK(table.rows() == 3);
  CHECK(table.text(0, table.column("Gamma")).empty());
  CHECK(table.number(0, table.column("T_z_se")) == 0.5);
  CHECK(table.text(0, table.column("T_x_se")).empty());
  CHECK(table.text(0, table.column("T_y")).empty());
  CHECK(table.number(1, table.column("T_y_se")) == 0.125);
  CHECK(table.text(1, table.column("reason")) == "not stationary: one plug");
  CHECK(table.number(2, table.column("replicates")) == 0);
  CHECK(table.text(2, table.column("T_z")).empty());
  CHECK(table.text(2, table.column("stationary")).empty());
}

TEST_CASE("An axis stands in for the point column of its name, and not for a quantity") {
  TableRow row;
  row.axis_cells = {"9"};
  row.point = {{"W", "1", 9.000000000000002}, {"Gamma", "1", 9}};
  row.quantities = {{"T_z", "m g d", {2, 0.5}}};
  row.replicates = 1;
  const auto table = collected_table({{"W", "1"}}, {row});
  CHECK(table.text(0, table.column("W")) == "9");
  CHECK(std::count_if(table.columns().begin(), table.columns().end(),
                      [](const auto& column) { return column.name == "W"; }) == 1);
  CHECK(table.number(0, table.column("Gamma")) == 9);
  CHECK_THROWS_WITH(collected_table({{"T_z", "1"}}, {row}), Catch::Contains("rename it with `as`"));
}

}  // namespace
}  // namespace shakebed::tests
