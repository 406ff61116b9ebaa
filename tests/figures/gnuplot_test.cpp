#include "figures/gnuplot.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>

#include "figures/figure.hpp"
#include "tests/figures/scratch.hpp"
#include "tests/figures/synthetic.hpp"

using namespace shakebed;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const fs::path specifications = fs::path(SHAKEBED_SOURCE_DIR) / "figures" / "bhateja2016";

figures::Tables canonical() {
  return {{"bhateja2016-canonical", tests::synthetic_canonical_table()}};
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// Draws one small script with one table of numbers.
void draw_script(const tests::ScratchFolder& folder, const std::string& script) {
  files::CsvTable table({{"x", "1"}, {"y", "1"}});
  table.add_row({"1", "2"});
  table.add_row({"2", "3"});
  table.write(folder.path() / "points.csv");
  figures::draw(folder.file("fig.gp", script),
                {{"points", folder.path() / "points.csv", table.columns()}}, {400, 300},
                folder.path() / "fig");
}

}  // namespace

TEST_CASE("the same tables give the same bytes") {
  const tests::ScratchFolder folder;
  for (const std::string id : {"fig02", "fig04"}) {
    const auto specification = figures::read_specification(specifications / (id + ".yaml"));
    const auto once = figures::make_figure(specification, canonical(), folder.path() / "once");
    const auto again = figures::make_figure(specification, canonical(), folder.path() / "again");
    REQUIRE(once.size() == again.size());
    for (std::size_t i = 0; i < once.size(); ++i) {
      CAPTURE(once[i].filename());
      CHECK(once[i].filename() == again[i].filename());
      CHECK(fs::file_size(once[i]) > 100);
      CHECK(tests::bytes_of(once[i]) == tests::bytes_of(again[i]));
    }
  }
}

TEST_CASE("a picture follows its table") {
  const tests::ScratchFolder folder;
  const auto specification = figures::read_specification(specifications / "fig02.yaml");
  auto tables = canonical();
  figures::make_figure(specification, tables, folder.path());
  const auto before = tests::bytes_of(folder.path() / "bhateja2016-fig02.svg");

  auto& table = tables.begin()->second;
  files::CsvTable doubled(table.columns());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> cells;
    for (std::size_t column = 0; column < table.columns().size(); ++column) {
      cells.push_back(table.columns()[column].name == "T_z_twice_scaled"
                          ? files::number_text(2 * table.number(row, column))
                          : table.text(row, column));
    }
    doubled.add_row(cells);
  }
  table = doubled;
  figures::make_figure(specification, tables, folder.path());
  CHECK(tests::bytes_of(folder.path() / "bhateja2016-fig02.svg") != before);
}

TEST_CASE("a missing gnuplot is said and leaves nothing behind") {
  const tests::ScratchFolder folder;
  setenv("SHAKEBED_GNUPLOT", "/nowhere/gnuplot", 1);
  const auto fault =
      tests::fault_of([&] { draw_script(folder, "plot points using points_x:points_y\n"); });
  unsetenv("SHAKEBED_GNUPLOT");
  CHECK(fault.where == "/nowhere/gnuplot");
  CHECK_THAT(fault.what, Contains("make deps") && Contains("SHAKEBED_GNUPLOT"));
  CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("gnuplot's own words are shown, and no picture is left when it stops") {
  const tests::ScratchFolder folder;
  const auto fault = tests::fault_of(
      [&] { draw_script(folder, "plot points using points_x:points_temperature\n"); });
  CHECK(fault.where == folder.path() / "fig.gp");
  CHECK_THAT(fault.what, Contains("line 1") && Contains("undefined variable: points_temperature"));
  CHECK(files_in(folder.path()) == 2);
}

TEST_CASE("a script that draws nothing is refused") {
  const tests::ScratchFolder folder;
  const auto fault = tests::fault_of([&] { draw_script(folder, "x = 1\n"); });
  CHECK_THAT(fault.what, Contains("drew nothing"));
  CHECK(files_in(folder.path()) == 2);
}
