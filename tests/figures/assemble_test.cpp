#include "figures/assemble.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/figures/scratch.hpp"
#include "tests/figures/synthetic.hpp"

using namespace shakebed;
using Catch::Contains;

namespace {

figures::Part part_of(std::vector<std::string> tables) {
  figures::Part part;
  part.name = "points";
  part.where = "fig.yaml:8:5";
  part.source = figures::NamedTables{std::move(tables)};
  return part;
}

figures::PartColumn copied(const std::string& column, const std::string& as) {
  return {figures::CopiedColumn{column, as, std::nullopt}, "fig.yaml:11:9"};
}

figures::Tables canonical() { return {{"canonical", tests::synthetic_canonical_table()}}; }

}  // namespace

TEST_CASE("columns are picked and renamed, numbers stay as they were written") {
  auto part = part_of({"canonical"});
  part.filters = {{"system", {"3D rough"}, "fig.yaml:9:14"}};
  part.columns = {copied("W", "x"), copied("T_z_twice_scaled", "y")};
  const auto tables = canonical();
  const auto& source = tables.at("canonical");
  const auto table = figures::assemble(part, tables);

  REQUIRE(table.rows() == 38);
  REQUIRE(table.columns().size() == 2);
  CHECK(table.columns()[0].name == "x");
  CHECK(table.columns()[1].unit == "m V_p^2");
  CHECK(table.provenance == source.provenance);
  const auto first = source.rows() - 38;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    CHECK(table.text(row, 0) == source.text(first + row, source.column("W")));
    CHECK(table.text(row, 1) == source.text(first + row, source.column("T_z_twice_scaled")));
  }
}

TEST_CASE("points that are at rest or not stationary are named") {
  auto part = part_of({"canonical"});
  part.columns = {copied("W", "W"),
                  copied("system", "system"),
                  {figures::StateColumn{"stationary", "at_rest"}, "fig.yaml:12:9"}};
  const auto table = figures::assemble(part, canonical());
  int at_rest = 0;
  int not_stationary = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto& state = table.text(row, 2);
    if (state == "at rest") {
      CHECK(table.number(row, 0) < 1);
      ++at_rest;
    } else if (state == "not stationary") {
      CHECK_THAT(table.text(row, 1), Catch::EndsWith("rough"));
      ++not_stationary;
    } else {
      CHECK(state == "steady");
    }
  }
  CHECK(at_rest == 8);
  CHECK(not_stationary == 2);
}

TEST_CASE("one replicate that differs marks the point") {
  CHECK(figures::state_of_point(1, 0) == "steady");
  CHECK(figures::state_of_point(1, 1) == "at rest");
  CHECK(figures::state_of_point(0, 1) == "at rest");
  CHECK(figures::state_of_point(1, 0.5) == "not stationary");
  CHECK(figures::state_of_point(0.75, 0) == "not stationary");
  CHECK(figures::state_of_point(std::nan(""), 0) == "missing");
  CHECK(figures::state_of_point(1, std::nan("")) == "missing");
}

TEST_CASE("tables are stacked when their headers agree") {
  files::CsvTable a({{"fit", ""}, {"a", "1"}});
  a.add_row({"one", "1"});
  a.provenance = {"git: abc", "fit: one"};
  files::CsvTable b({{"fit", ""}, {"a", "1"}});
  b.add_row({"two", "2"});
  b.provenance = {"git: abc", "fit: two"};
  files::CsvTable other({{"fit", ""}, {"a", "m"}});

  const auto both = figures::assemble(part_of({"a", "b"}), {{"a", a}, {"b", b}});
  REQUIRE(both.rows() == 2);
  CHECK(both.text(1, 0) == "two");
  CHECK(both.provenance == std::vector<std::string>{"git: abc", "fit: one", "fit: two"});

  const auto fault = tests::fault_of([&] {
    figures::assemble(part_of({"a", "other"}), {{"a", a}, {"other", other}});
  });
  CHECK(fault.where == "fig.yaml:8:5");
  CHECK_THAT(fault.what, Contains("different columns"));
}

TEST_CASE("a missing table, column or system is refused with the specification's place") {
  const auto missing = tests::fault_of([] { figures::assemble(part_of({"absent"}), canonical()); });
  CHECK(missing.where == "fig.yaml:8:5");
  CHECK_THAT(missing.what, Contains("--table absent=FILE"));

  auto part = part_of({"canonical"});
  part.columns = {copied("T_z_twice_scald", "T_z")};
  const auto column = tests::fault_of([&] { figures::assemble(part, canonical()); });
  CHECK(column.where == "fig.yaml:11:9");
  CHECK_THAT(column.what, Contains("T_z_twice_scaled"));

  part.columns.clear();
  part.filters = {{"system", {"4D rough"}, "fig.yaml:9:14"}};
  const auto rows = tests::fault_of([&] { figures::assemble(part, canonical()); });
  CHECK(rows.where == "fig.yaml:9:14");
  CHECK_THAT(rows.what, Contains("no row"));
}
