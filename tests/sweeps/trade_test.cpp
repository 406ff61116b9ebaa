#include "sweeps/trade.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "simulator/contact/parameters.hpp"
#include "simulator/scene/read_scene.hpp"
#include "sweeps/collect.hpp"
#include "tests/sweeps/small_sweep.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::sweeps;

std::size_t row_of(const Grid& grid, const std::string& axis, const std::string& value) {
  for (std::size_t k = 0; k < grid.points.size(); ++k) {
    if (grid.points[k].labels == std::vector<std::string>{axis, value}) return k;
  }
  FAIL("no setting " << axis << " = " << value);
  return 0;
}

TEST_CASE("A trade study changes one setting at a time") {
  const tests::SmallSweep small;
  const Grid grid = trade_grid(small.folder.path() / "scene.yaml", {}, TradeProfile::shipped);
  const auto scene = [&](const char* axis, const char* value) {
    return grid.points[row_of(grid, axis, value)].scene;
  };
  const auto base = scene("reference", "50");
  const double k_n = bind_parameters(base).stiffness;
  CHECK(scene("dt stepped", "10").protocol.time_step_fraction == 0.1);
  CHECK(scene("dt stepped", "10").protocol.contacts == simulator::ContactOperator::fine);
  CHECK(scene("dt closed", "5").protocol.contacts == simulator::ContactOperator::closed);
  CHECK(scene("dt uniform", "10").protocol.engine == simulator::Engine::uniform);
  CHECK(*scene("k_n", "0.1").contact.stiffness == Approx(0.1 * k_n));
  CHECK(scene("k_n", "0.1").protocol.time_step_fraction == base.protocol.time_step_fraction);
  // A grain thrown at V_p = 3 flies for 6 sqrt(d/g), 2.9 periods.
  CHECK(scene("cycles", "120").protocol.cycles == std::lround(std::ceil(120 * 9 / M_PI)));
  CHECK_FALSE(scene("cycles", "120").protocol.until);
  CHECK(scene("cell", "2").grains.count == 2 * base.grains.count);
  CHECK(scene("cell", "2").cell[0] == 2 * base.cell[0]);
  CHECK(bind_parameters(scene("cell", "2")).stiffness == Approx(k_n));
}

// c_n = 2 m_eff gamma with e = exp(-gamma t_c): one c_n for both kinds of contact loses less at the
// base, where m_eff is twice as large.
TEST_CASE("The axis of one dashpot for all contacts has the pair's c_n at the base") {
  const tests::SmallSweep small;
  const Grid grid =
      trade_grid(small.folder.path() / "scene.yaml",
                 {{"grains.restitution", "0.8"}, {"base.restitution", "0.8"}}, TradeProfile::quick);
  for (const auto& point : grid.points) {
    const auto p = bind_parameters(point.scene);
    const double ratio = p.grain_base.normal_damping / p.grain_grain.normal_damping;
    if (point.labels[0] == "pair dashpot at base") {
      CHECK(ratio == Approx(1).epsilon(1e-12));
      CHECK(std::stod(point.labels[1]) == Approx(0.8542).epsilon(1e-4));
    } else if (point.labels[0] == "reference") {
      CHECK(ratio == Approx(std::sqrt(2)).epsilon(1e-12));
    }
  }
}

TEST_CASE("Replicates share out one number of flights, and a study may have some axes alone") {
  const tests::SmallSweep small;
  Grid grid = trade_grid(small.folder.path() / "scene.yaml", {}, TradeProfile::shipped);
  const auto& four = grid.points[row_of(grid, "replicates", "4")];
  const auto& alone = grid.points[row_of(grid, "replicates", "1")];
  CHECK(grid.replicates_of(four) == 4);
  CHECK(*alone.scene.protocol.cycles ==
        Approx(4 * static_cast<double>(*four.scene.protocol.cycles)).margin(4));
  keep_axes(grid, {"replicates", "cycles"});
  CHECK(grid.points.size() == 1 + 3 + 3);
  CHECK(runs_of(grid).size() == 1 + 3 + 1 + 4 + 16);
  CHECK_THROWS_WITH(keep_axes(grid, {"skin"}),
                    Catch::Contains("no axis `skin`") && Catch::Contains("`replicates`"));
}

TEST_CASE("A cell too narrow to halve is not halved") {
  const tests::SmallSweep small;  // 5 d: half is 2.5 d; 4 d: half is 2 d
  const auto file = small.folder.path() / "scene.yaml";
  const auto halved = [&](const std::vector<simulator::Override>& set) {
    const Grid grid = trade_grid(file, set, TradeProfile::shipped);
    return std::any_of(grid.points.begin(), grid.points.end(), [](const Point& point) {
      return point.labels == std::vector<std::string>{"cell", "0.5"};
    });
  };
  CHECK(halved({}));
  CHECK_FALSE(halved({{"cell", "[4]"}}));
}

TEST_CASE("Beds that have no choice of engine are refused") {
  const tests::SmallSweep small;
  CHECK_THROWS_WITH(
      trade_grid(small.folder.path() / "scene.yaml", {{"lid.height", "20"}}, TradeProfile::quick),
      Catch::Contains("take a periodic bed"));
}

TEST_CASE("All scenes are timed before any is timed again, and the least counts") {
  const tests::SmallSweep small;
  const Grid grid = trade_grid(small.folder.path() / "scene.yaml", {}, TradeProfile::quick);
  const std::vector<simulator::Scene> scenes{grid.points[0].scene, grid.points[1].scene};
  std::vector<double> order;
  int calls = 0;
  const auto runner = [&](const simulator::Scene& scene, const simulator::RunControl&) {
    order.push_back(scene.protocol.time_step_fraction);
    auto record = tests::pretended_record(scene);
    const double per_cycle = (++calls == 3 ? 1e-2 : 2e-2);  // the second round is faster for one
    record.timing.cpu_seconds_measuring = per_cycle * static_cast<double>(*scene.protocol.cycles);
    return record;
  };
  const auto seconds = time_in_turns(scenes, 2, runner);
  REQUIRE(order.size() == 4);
  CHECK(order[0] == order[2]);
  CHECK(order[1] == order[3]);
  CHECK(order[0] != order[1]);
  CHECK(seconds[0] == Approx(10));
  CHECK(seconds[1] == Approx(20));
}

TEST_CASE("Bias is against the reference, for k_n against the hardest, with both errors") {
  const tests::SmallSweep small;
  const Grid grid = trade_grid(small.folder.path() / "scene.yaml", {}, TradeProfile::quick);
  files::CsvTable collected({{"T_z", "m g d"},
                             {"T_z_se", "m g d"},
                             {"T_x", "m g d"},
                             {"T_x_se", "m g d"},
                             {"h_cm", "d"},
                             {"h_cm_se", "d"},
                             {"T_z_scaled", "m V_p^2"},
                             {"W", "1"},
                             {"layers", "1"},
                             {"grains", "1"},
                             {"k_n", "m g/d"},
                             {"largest_overlap", "d"},
                             {"cycles", "1"},
                             {"stationary", "1"},
                             {"at_rest", "1"},
                             {"transient", "cycles"},
                             {"reason", ""}});
  for (std::size_t k = 0; k < grid.points.size(); ++k) {
    const std::string T_z = std::to_string(2 + 0.1 * static_cast<double>(k));
    collected.add_row({T_z, "0.03", "1", "0.1", "3", "0.1", "0.2", "9", "2", "10", "1e5", "0.01",
                       "100", "1", "0", "40", ""});
  }
  const auto table =
      trade_table("small", grid, collected, std::vector<double>(grid.points.size(), 5));
  const auto number = [&](std::size_t row, const char* name) {
    return table.number(row, table.column(name));
  };
  const std::size_t stepped = row_of(grid, "dt stepped", "5");
  const double T_z = 2 + 0.1 * static_cast<double>(stepped);
  CHECK(number(stepped, "T_z_bias") == Approx(100 * (T_z / 2 - 1)));
  CHECK(number(stepped, "T_z_bias_se") == Approx(100 * T_z / 2 * std::hypot(0.03 / T_z, 0.03 / 2)));
  const std::size_t soft = row_of(grid, "k_n", "0.1");
  const double soft_T_z = 2 + 0.1 * static_cast<double>(soft);
  const double hard_T_z = 2 + 0.1 * static_cast<double>(row_of(grid, "k_n", "30"));
  CHECK(number(soft, "T_z_bias") == Approx(100 * (soft_T_z / hard_T_z - 1)));
  // 100 cycles gave 1.5 % at T_z = 2: 225 would give 1 %, at 5 s per 1000.
  CHECK(number(0, "cycles_for_1_percent") == Approx(225));
  CHECK(number(0, "seconds_for_1_percent") == Approx(1.125));
  // Four runs discard 40 cycles each beside the 100 measured in all.
  const std::size_t split = row_of(grid, "replicates", "4");
  CHECK(number(split, "seconds_for_1_percent") ==
        Approx(1e-3 * 5 * 2.6 * number(split, "cycles_for_1_percent")));
}

}  // namespace
