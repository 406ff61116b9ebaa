#include "fitting/measurements.hpp"

#include <catch2/catch.hpp>

#include "tests/fitting/table.hpp"

using namespace shakebed::fitting;

namespace {

RowChoice rough_3d() { return {{{"system", "3D rough", "fit.yaml:3:5"}}, {}, 1}; }

Measurements read(const shakebed::files::CsvTable& table, const RowChoice& choice, double from,
                  double to) {
  return read_measurements(table, choice, "W", "T_z_scaled", "T_z_scaled_se", {"W", from, to});
}

constexpr std::size_t first_3d_row = 48;  // after 300 to 5000 rpm of 2D rough

}  // namespace

TEST_CASE("rows at rest, not stationary or not measured are left out and named", "[measurements]") {
  auto table = collected_table(0.01, 1);
  table = with_cell(table, first_3d_row + 10, "stationary", "0.5");
  table = with_cell(table, first_3d_row + 20, "T_z_scaled", "");
  table = with_cell(table, first_3d_row + 2, "T_z_scaled", "5e-7");  // 500 rpm
  const auto got = read(table, rough_3d(), 0, 1000);
  CHECK(got.points.size() == 48 - 5);
  REQUIRE(got.dropped.size() == 5);
  CHECK(got.dropped[0].reason == "at rest");  // 300 and 400 rpm: W < 1
  CHECK(got.dropped[1].reason == "at rest");
  CHECK_THAT(got.dropped[2].reason, Catch::Contains("below onset"));
  CHECK_THAT(got.dropped[3].reason, Catch::Contains("stationary in 0.5"));
  CHECK(got.dropped[4].reason == "not measured");
  CHECK(got.x_unit == "1");
  CHECK(got.y_unit == "m V_p^2");
  auto lenient = rough_3d();
  lenient.minimum_stationary = 0.5;
  CHECK(read(table, lenient, 0, 1000).points.size() == 48 - 4);
}

TEST_CASE("a range keeps both of its ends, in order of x", "[measurements]") {
  const auto table = collected_table(0.01, 1);
  const auto got = read(table, rough_3d(), W_at(1000), W_at(2000));
  REQUIRE(got.points.size() == 11);
  CHECK(got.points.front().x == W_at(1000));
  CHECK(got.points.back().x == W_at(2000));
  CHECK(std::ranges::is_sorted(got.points, {}, &Point::x));
  CHECK(got.outside_range == 48 - 2 - 11);
}

TEST_CASE("excluded rows carry the reason of the fit file", "[measurements]") {
  auto choice = rough_3d();
  choice.exclude = {{"W", 1.3, 1.5, "hops"}};
  const auto got = read(collected_table(0.01, 1), choice, 0, 1000);
  REQUIRE(got.dropped.size() == 3);
  CHECK(got.dropped[2].W == W_at(500));
  CHECK(got.dropped[2].reason == "hops");
}

TEST_CASE("a selection that matches nothing says what there is", "[measurements]") {
  const auto table = collected_table(0.01, 1);
  const RowChoice choice{{{"system", "3D smooth", "fit.yaml:3:5"}}, {}, 1};
  CHECK_THROWS_WITH(read(table, choice, 0, 1),
                    Catch::Contains("fit.yaml:3:5") &&
                        Catch::Contains("no row of collected.csv has system = 3D smooth") &&
                        Catch::Contains("2D rough, 3D rough"));
  CHECK_THROWS_WITH(read_measurements(table, rough_3d(), "W", "T_zscaled", "", {"W", 0, 1}),
                    Catch::Contains("T_zscaled") && Catch::Contains("T_z_scaled"));
}

TEST_CASE("numbers select by value, not by spelling", "[measurements]") {
  const auto table = collected_table(0.01, 1);
  CHECK(selected_rows(table, {{"frequency_rpm", "1e3", ""}}).size() == 2);
  CHECK(
      selected_rows(table, {{"frequency_rpm", "1000.0", ""}, {"system", "2D rough", ""}}).size() ==
      1);
}

TEST_CASE("groups are the different values of the columns", "[measurements]") {
  const auto table = collected_table(0.01, 1);
  const std::vector<std::vector<std::string>> expected{{"2D rough"}, {"3D rough"}};
  CHECK(groups(table, {}, {"system"}) == expected);
  CHECK(groups(table, {}, {}).size() == 1);
}
