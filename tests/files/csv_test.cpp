#include "files/csv.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "files/atomic_file.hpp"
#include "tests/figures/scratch.hpp"

namespace {

using namespace shakebed;
using files::CsvTable;
using Limits = std::numeric_limits<double>;

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

CsvTable written_and_read(const CsvTable& table) {
  const tests::ScratchFolder scratch;
  table.write(scratch.path() / "table.csv");
  return CsvTable::read(scratch.path() / "table.csv");
}

files::Fault reading(const std::string& text) {
  const tests::ScratchFolder scratch;
  const auto file = scratch.file("t.csv", text);
  auto fault = tests::fault_of([&] {
    const CsvTable table = CsvTable::read(file);
    for (const auto& column : table.columns()) table.numbers(column.name);
  });
  const std::string prefix = scratch.path().string() + "/";
  if (fault.where.starts_with(prefix)) fault.where.erase(0, prefix.size());
  return fault;
}

TEST_CASE("Every double comes back from a table bit by bit, denormals too") {
  std::vector<double> values{0.0,
                             -0.0,
                             1.0 / 3,
                             0.1,
                             Limits::min(),
                             Limits::denorm_min(),
                             Limits::max(),
                             -Limits::denorm_min(),
                             1e22,
                             9007199254740993.0,
                             5e-324,
                             Limits::infinity(),
                             -Limits::infinity()};
  std::mt19937_64 random(20261122);
  while (values.size() < 20000) {
    const double value = std::bit_cast<double>(random());
    if (!std::isnan(value)) values.push_back(value);
  }
  while (values.size() < 22000) {  // denormals: exponent bits all zero
    values.push_back(std::bit_cast<double>(random() & 0x800fffffffffffffULL));
  }
  CsvTable table(std::vector<files::CsvColumn>{{"x", "d"}});
  for (const double value : values) table.add_row({files::number_text(value)});
  const auto back = written_and_read(table).numbers("x");
  REQUIRE(back.size() == values.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    different += same_bits(back[i], values[i]) ? 0 : 1;
  CHECK(different == 0);
}

TEST_CASE("Numbers are written in their shortest form, a missing one as nothing") {
  CHECK(files::number_text(0.1) == "0.1");
  CHECK(files::number_text(1000) == "1000");
  CHECK(files::number_text(1e-300) == "1e-300");
  CHECK(files::number_text(Limits::quiet_NaN()).empty());
  CHECK(files::number_from_text("1e3") == 1000);
  CHECK(files::number_from_text("+2") == 2);
  for (const char* text : {"", "1 ", " 1", "1,5", "1e999", "0x10", "+-1", "one"}) {
    CAPTURE(text);
    CHECK_FALSE(files::number_from_text(text));
  }
}

TEST_CASE("Cells of any text come back") {
  std::mt19937_64 random(7);
  const std::string alphabet = "ab ,\"\n\r#[]\t;'1.\xc3\xa9";
  const auto cell = [&] {
    std::string text;
    const auto length = random() % 6;
    while (text.size() < length) text += alphabet[random() % alphabet.size()];
    return text;
  };
  for (int round = 0; round < 300; ++round) {
    CsvTable table({{"first", ""}, {"second [odd], name", "m V_p^2"}, {"third", "1"}});
    table.provenance = {"sweep: bhateja2016", "", "# twice"};
    for (int row = 0; row < 4; ++row) table.add_row({cell(), cell(), cell()});
    const CsvTable back = written_and_read(table);
    REQUIRE(back.rows() == 4);
    REQUIRE(back.provenance == table.provenance);
    REQUIRE(back.columns()[1].name == table.columns()[1].name);
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t column = 0; column < 3; ++column) {
        REQUIRE(back.text(row, column) == table.text(row, column));
      }
    }
  }
}

TEST_CASE("A table on disk has provenance, names with units, and rows in order") {
  CsvTable table({{"system", ""}, {"T_z", "m g d"}});
  table.provenance = {"sweep: bhateja2016"};
  table.add_row({"2D smooth", files::number_text(0.5)});
  table.add_row({"a, b", files::number_text(Limits::quiet_NaN())});
  CHECK(table.to_text() ==
        "# sweep: bhateja2016\n"
        "system [],T_z [m g d]\n"
        "2D smooth,0.5\n"
        "\"a, b\",\n");
  const CsvTable back = written_and_read(table);
  CHECK(back.provenance == table.provenance);
  CHECK(back.columns()[1].name == "T_z");
  CHECK(back.columns()[1].unit == "m g d");
  CHECK(std::isnan(back.number(1, 1)));
}

TEST_CASE("A cell that other readers would take for a comment is quoted") {
  CsvTable table({{"#1", ""}, {"b", ""}});
  table.add_row({"# no comment", "#"});
  CHECK(table.to_text() == "\"#1 []\",b []\n\"# no comment\",\"#\"\n");
  CHECK(written_and_read(table).columns()[0].name == "#1");
}

TEST_CASE("A table of one column keeps its missing values") {
  CsvTable table(std::vector<files::CsvColumn>{{"x", "1"}});
  table.add_row({""});
  table.add_row({"1"});
  CHECK(written_and_read(table).rows() == 2);
}

TEST_CASE("Tables written by other programs are read") {
  const tests::ScratchFolder scratch;
  const CsvTable table = CsvTable::read(scratch.file("t.csv", "x,y [d]\r\n1,2\r\n3,\"4\""));
  REQUIRE(table.rows() == 2);
  CHECK(table.columns()[0].unit.empty());
  CHECK(table.numbers("y") == std::vector<double>{2, 4});
}

TEST_CASE("A damaged table is refused at its line") {
  struct Case {
    std::string text, where, what;
  };
  const Case cases[] = {
      {"", "t.csv", "no header"},
      {"# only\n", "t.csv", "no header"},
      {"x,y\n1,2\n1\n", "t.csv:3", "expected 2 cells, one a column, got 1"},
      {"x,y\n1,2,3\n", "t.csv:2", "got 3"},
      {"# a\nx,x\n", "t.csv:2", "column `x` stands there twice"},
      {"x,y\n\"1\n,2\n", "t.csv:2", "never closed"},
      {"x,y\n\"1\"2,2\n", "t.csv:2", "expected a comma"},
      {"x,y\n\"a\nb\",2\n1,oops\n", "t.csv:2", "column `x`: expected a number"},
      {"x,y\n1,2\n\"1\",oops\n", "t.csv:3", "column `y`: expected a number, got `oops`"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.text);
    const auto fault = reading(one.text);
    CHECK(fault.where == one.where);
    CHECK_THAT(fault.what, Catch::Contains(one.what));
  }
}

TEST_CASE("A column that is not there is answered with the nearest") {
  const CsvTable table({{"T_z", ""}, {"T_x", ""}, {"W", ""}});
  const auto fault = tests::fault_of([&] { table.column("T_zz"); });
  CHECK(fault.where == "table");
  CHECK(fault.what == "has no column `T_zz`; the nearest is `T_z`");
  CHECK_THAT(tests::fault_of([&] { table.column("packing"); }).what,
             Catch::Contains("it has T_z T_x W"));
  CHECK_FALSE(table.has_column("packing"));
}

TEST_CASE("A row of the wrong length never gets in") {
  CsvTable table({{"x", ""}, {"y", ""}});
  CHECK_THAT(tests::fault_of([&] { table.add_row({"1"}); }).what,
             Catch::Contains("expected 2 cells"));
  CHECK(table.rows() == 0);
}

}  // namespace
