#include <catch2/catch.hpp>
#include <set>

#include "simulator/contact/column_parameters.hpp"
#include "simulator/observables/column_series.hpp"
#include "simulator/scene/column.hpp"
#include "sweeps/column_table.hpp"
#include "sweeps/ensemble.hpp"
#include "tests/sweeps/small_sweep.hpp"

namespace shakebed::tests {
namespace {

using sweeps::store::Cache;

const std::filesystem::path folder = std::filesystem::path(SHAKEBED_SWEEPS_FOLDER) / "sun2006";

TEST_CASE("Every sweep of Sun 2006 stands on Table I at its paper profile") {
  int sweeps_seen = 0;
  for (const auto& item : std::filesystem::directory_iterator(folder)) {
    if (item.path().filename() == "scene.yaml") continue;
    CAPTURE(item.path());
    ++sweeps_seen;
    for (const auto& point : sweeps::read_grid(item.path(), "paper").points) {
      const auto& scene = point.scene;
      REQUIRE(scene.column);
      CHECK(scene.column->diameter == 12.25);
      CHECK((scene.grains.count == 7600 || scene.grains.count == 6000));
      CHECK(scene.column->large_diameter == 3.16);
      // 13.54/1.91 = 7.09; the density of a small grain is 6/pi m/d^3.
      CHECK(scene.column->large_density == Approx(7.09).margin(0.005));
      CHECK(scene.base.drive.amplitude == 7.5);
      CHECK(scene.Gamma() == Approx(3.39).margin(0.005));
      CHECK(scene.column->grain.normal_rate == 40);
      CHECK(scene.column->grain.tangential_rate == 0);
      CHECK(scene.column->wall.tangential_rate == 20);
      // Table I's step is t_c/24.8, at other stiffnesses as many; that of the text is t_c/50.
      if (scene.column->smallest < 1) continue;  // lighter grains, shorter contacts
      const auto p = simulator::bind_column(scene);
      const double share = p.contact_duration / p.time_step;
      CHECK((share == Approx(24.8).margin(0.4) || share == Approx(50).margin(0.1)));
    }
  }
  CHECK(sweeps_seen == 12);
}

TEST_CASE("Beds that several figures of Sun 2006 show are run once") {
  std::set<std::string> keys;
  std::size_t runs = 0;
  for (const char* name : {"air", "friction", "law", "stiffness", "wall_friction"}) {
    for (const auto& run :
         sweeps::runs_of(sweeps::read_grid(folder / (std::string(name) + ".yaml"), "paper"))) {
      keys.insert(run.identity.key);
      ++runs;
    }
  }
  CHECK(runs == 18);
  CHECK(keys.size() == 14);  // each has the bed of Table I with 6001 grains
}

// Fig. 2 shows the bed of the runs after it, and runs that differ in friction, drag or step alone
// start from one packing.
TEST_CASE("Runs of Sun 2006 that can start from the same bed do") {
  const auto beds_of = [](std::set<std::string>& prepared, std::set<std::string>& poured,
                          std::initializer_list<const char*> names) {
    for (const char* name : names) {
      for (const auto& run :
           sweeps::runs_of(sweeps::read_grid(folder / (std::string(name) + ".yaml"), "paper"))) {
        prepared.insert(simulator::preparation_text(run.scene));
        poured.insert(simulator::pouring_text(run.scene));
      }
    }
  };
  std::set<std::string> prepared, poured;
  beds_of(prepared, poured, {"prepared"});
  CHECK(prepared.size() == 2);
  beds_of(prepared, poured, {"damping", "air"});
  CHECK(prepared.size() == 2);
  beds_of(prepared, poured, {"walls", "friction", "wall_friction"});
  CHECK(prepared.size() == 2 + 1 + 3 + 4);  // walls: mu_wall = 0; mu and mu_wall are 0.5 in one
  CHECK(poured.size() == 2);
  beds_of(prepared, poured, {"networks"});
  CHECK(poured.size() == 2 + 3);  // replicas have their own
}

TEST_CASE("The series table samples equal phases between two cycles, and says what it cannot") {
  const SmallSweep small;
  const Cache cache(small.folder.path() / "cache");
  files::write_text(small.folder.path() / "scene.yaml",
                    "scene: 1\ndimension: 3\ncontainer: {cylinder: {diameter: 6}}\n"
                    "grains: {count: 20, friction: 0.5, large: {diameter: 2, density_ratio: 2}}\n"
                    "base: {drive: {frequency: 0.1, amplitude: 7.5}}\n"
                    "contact: {stiffness: 2e5, gamma_n: 40, tangential: {law: cundall_strack}}\n"
                    "protocol: {measure: {cycles: 3}}\nseed: 1\n");
  const auto grid = small.grid("axes: [{key: grains.friction, values: [0.1, 0.5]}]\n");
  sweeps::run_ensemble(sweeps::runs_of(grid), cache,
                       [](const auto& scene, const auto&) {
                         auto record = pretended_record(scene);
                         record.series.clear();
                         for (std::size_t c = 0; c < simulator::ColumnSeries::columns; ++c) {
                           const auto column = static_cast<simulator::ColumnSeries::Column>(c);
                           simulator::Series one{simulator::ColumnSeries::name(column),
                                                 simulator::ColumnSeries::unit(column),
                                                 1. / 160,
                                                 {}};
                           for (int k = 0; k < 480; ++k) {
                             one.values.push_back(static_cast<double>(1000 * c) + k);
                           }
                           record.series.push_back(one);
                         }
                         return record;
                       },
                       {1, {}, nullptr});
  const auto collected = sweeps::collect_series(grid, cache, {4, 1, 2});
  const auto& table = collected.table;
  REQUIRE(table.rows() == 2 * 5);  // T = 1, 1.25, 1.5, 1.75, 2 of two points
  CHECK(table.numbers("T")[3] == 1.75);
  CHECK(table.numbers("phase")[3] == 0.75);
  CHECK(table.numbers("phase")[4] == 0);
  CHECK(table.numbers("large_height")[3] == 280);
  CHECK(table.numbers("coordination")[3] == 1000 * simulator::ColumnSeries::coordination + 280);
  // Column 0 less column 2.
  CHECK(table.numbers("large_over_centre")[3] == -2000);
  CHECK_THROWS_WITH(sweeps::collect_series(grid, cache, {7, 0, 9}),
                    Catch::Contains("expected a divisor of that, got 7"));
  CHECK_THROWS_WITH(sweeps::collect_series(
                        SmallSweep().grid("axes: [{key: base.drive.W, values: [4]}]\n"), cache, {}),
                    Catch::Contains("container"));
}

}  // namespace
}  // namespace shakebed::tests
