#include "sweeps/collect.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "sweeps/ensemble.hpp"
#include "tests/sweeps/small_sweep.hpp"

namespace shakebed::tests {
namespace {

using sweeps::store::Cache;

const std::string three_points =
    "axes: [{key: base.drive.W, values: [4, 9, 16], as: W_set}]\nreplicates: 2\n";

void make(const std::vector<sweeps::Run>& runs, const Cache& cache) {
  sweeps::run_ensemble(runs, cache,
                       [](const auto& scene, const auto&) { return pretended_record(scene); },
                       {2, {}, nullptr});
}

TEST_CASE("One row a point, in the grid's order, with provenance") {
  const SmallSweep small;
  const auto grid = small.grid(three_points);
  const auto runs = sweeps::runs_of(grid);
  const Cache cache(small.folder.path() / "cache");
  make(runs, cache);
  const auto collected = sweeps::collect(grid, cache);
  CHECK(collected.runs_present == 6);
  CHECK(collected.runs_missing == 0);
  const auto& table = collected.table;
  REQUIRE(table.rows() == 3);
  CHECK(table.numbers("W_set") == std::vector<double>{4, 9, 16});
  CHECK(table.number(1, table.column("W")) == Approx(9));
  CHECK(table.number(1, table.column("replicates")) == 2);
  CHECK(table.number(1, table.column("cycles")) == 20);
  CHECK(table.number(1, table.column("collisions")) == 200);
  CHECK(table.number(1, table.column("grains")) == 10);
  CHECK(table.number(1, table.column("stationary")) == 1);
  const double a = pretended_record(runs[2].scene).quantities[0].estimate.mean;
  const double b = pretended_record(runs[3].scene).quantities[0].estimate.mean;
  CHECK(table.number(1, table.column("T_z")) == Approx((a + b) / 2).epsilon(1e-14));
  CHECK(table.number(1, table.column("T_z_se")) >= 0.01 / std::sqrt(2.0) * (1 - 1e-12));

  const std::string text = table.to_text();
  CHECK_THAT(text, Catch::Contains("# sweep: small\n# profile: quick\n# physics version: "));
  CHECK_THAT(text, Catch::Contains("# points: 3, runs: 6\n# digest of the run keys: "));
  CHECK(sweeps::collect(grid, cache).table.to_text() == text);
}

TEST_CASE("What is missing is said and left empty") {
  const SmallSweep small;
  const auto grid = small.grid(three_points);
  auto runs = sweeps::runs_of(grid);
  const Cache cache(small.folder.path() / "cache");
  // The point W = 9 lacks both replicates, W = 16 one.
  make({runs[0], runs[1], runs[5]}, cache);
  cache.note_failure(runs[2].identity, "the bed never settles");
  const auto collected = sweeps::collect(grid, cache);
  CHECK(collected.runs_present == 3);
  CHECK(collected.runs_missing == 3);
  const auto& table = collected.table;
  REQUIRE(table.rows() == 3);
  CHECK(table.text(1, table.column("T_z")).empty());
  CHECK(table.number(1, table.column("W")) == Approx(9));
  CHECK(table.number(1, table.column("replicates")) == 0);
  CHECK(table.text(1, table.column("reason")) == "not run");
  CHECK(table.number(2, table.column("replicates")) == 1);
  CHECK_THAT(table.to_text(), Catch::Contains("# incomplete: 3 runs are missing"));

  const auto status = sweeps::status_of(grid, cache);
  CHECK(status.cached == 3);
  CHECK(status.missing == 3);
  CHECK(status.spent_cpu_seconds == Approx(3 * pretended_cpu_seconds));
  CHECK(status.failed == 1);
  CHECK(status.predicted_cpu_seconds > 0);
  REQUIRE(status.failures.size() == 1);
  CHECK(status.failures[0] == "W_set = 9: the bed never settles");
}

TEST_CASE("A damaged run is left out of the table and said") {
  const SmallSweep small;
  const auto grid = small.grid(three_points);
  const auto runs = sweeps::runs_of(grid);
  const Cache cache(small.folder.path() / "cache");
  make(runs, cache);
  files::write_text(cache.file_of(runs[0].identity.key), "");
  const auto collected = sweeps::collect(grid, cache);
  CHECK(collected.runs_missing == 1);
  REQUIRE(collected.problems.size() == 1);
  CHECK_THAT(collected.problems[0], Catch::Contains(runs[0].identity.key));
  CHECK(sweeps::status_of(grid, cache).missing == 1);
}

TEST_CASE("Collecting an empty cache makes no cache") {
  const SmallSweep small;
  const auto grid = small.grid(three_points);
  const Cache cache(small.folder.path() / "cache");
  CHECK(sweeps::collect(grid, cache).runs_present == 0);
  CHECK_FALSE(std::filesystem::exists(cache.folder()));
}

// Two boxes; the second only where the seed is even, so that replicates reach different heights.
simulator::Record record_with_profile(const simulator::Scene& scene) {
  auto record = pretended_record(scene);
  const bool high = scene.seed % 2 == 0;
  auto& profile = record.profile;
  profile.z = high ? std::vector<double>{0.5, 1.5} : std::vector<double>{0.5};
  const auto cut = [&](std::vector<double> values) {
    values.resize(profile.z.size());
    return values;
  };
  profile.columns = {{"grains_in_box", "1", cut({8, 2}), cut({0.1, 0.1})},
                     {"phi", "1", cut({0.4, 0.1}), cut({0.01, 0.01})},
                     {"T_x", "m g d", cut({1, 3}), cut({0.1, 0.1})},
                     {"T_z", "m g d", cut({2, 6}), cut({0.1, 0.1})}};
  return record;
}

TEST_CASE(
    "Profiles are one row a box, replicates that reach a box and those that do not combined") {
  const SmallSweep small;
  const auto grid = small.grid("axes: [{key: base.drive.W, values: [4, 9]}]\nreplicates: 6\n");
  const auto runs = sweeps::runs_of(grid);
  const Cache cache(small.folder.path() / "cache");
  sweeps::run_ensemble(runs, cache,
                       [](const auto& scene, const auto&) { return record_with_profile(scene); },
                       {1, {}, nullptr});
  CHECK(sweeps::collect(grid, cache).profiles.rows() == 0);
  const auto table = sweeps::collect(grid, cache, sweeps::With::averages_and_profiles).profiles;
  int high = 0;
  for (int r = 0; r < 6; ++r) high += runs[r].scene.seed % 2 == 0;
  REQUIRE(high > 0);
  REQUIRE(high < 6);
  REQUIRE(table.rows() == 4);
  const auto at = [&](std::size_t row, const char* name) {
    return table.number(row, table.column(name));
  };
  CHECK(at(0, "z") == 0.5);
  CHECK(at(0, "grains_in_box") == Approx(8));
  // An empty box counts as no grains, but not as cold ones.
  CHECK(at(1, "z") == 1.5);
  CHECK(at(1, "grains_in_box") == Approx(2.0 * high / 6));
  CHECK(at(1, "T_z") == Approx(6));
  CHECK(at(1, "T_z_twice_scaled") == Approx(2 * 6 / 4.0));
  CHECK(at(3, "T_z_twice_scaled") == Approx(2 * 6 / 9.0));
  CHECK(std::isnan(at(0, "T_y")));
  CHECK(std::isnan(at(0, "T_z_instant")));
  CHECK(at(0, "stationary") == 1);
}

simulator::Record record_with_snapshots(const simulator::Scene& scene) {
  auto record = pretended_record(scene);
  for (const double phase : scene.protocol.snapshots.phases) {
    simulator::Snapshot snapshot;
    snapshot.name = phase == 0 ? "T7" : "T7.5";
    snapshot.cycles = 7 + phase;
    snapshot.base_height = -phase;
    snapshot.radius = {0.5, 0.5};
    snapshot.position = {{1, 0, 2}, {3, 0, 4}};
    snapshot.velocity = {{0, 0, 0}, {3, 0, 4}};
    record.snapshots.push_back(snapshot);
  }
  return record;
}

TEST_CASE("Snapshots are one row a grain, with the speed over V_p") {
  const SmallSweep small;
  const Cache cache(small.folder.path() / "cache");
  const std::string axes = "axes: [{key: base.drive.W, values: [4, 25]}]\nreplicates: 2\n";
  CHECK_THROWS_WITH(sweeps::collect_snapshots(small.grid(axes), cache),
                    Catch::Contains("protocol.snapshots"));
  const auto grid = small.grid("set: {protocol.snapshots.phases: [0, 0.5]}\n" + axes);
  sweeps::run_ensemble(sweeps::runs_of(grid), cache,
                       [](const auto& scene, const auto&) { return record_with_snapshots(scene); },
                       {1, {}, nullptr});
  const auto collected = sweeps::collect_snapshots(grid, cache);
  CHECK(collected.runs_present == 4);
  const auto& table = collected.table;
  REQUIRE(table.rows() == 2 * 2 * 2 * 2);  // points, replicates, snapshots, grains
  const auto at = [&](std::size_t row, const char* name) {
    return table.number(row, table.column(name));
  };
  CHECK(at(0, "W") == 4);
  CHECK(at(15, "W") == 25);
  CHECK(at(0, "speed") == 0);
  CHECK(at(1, "speed") == Approx(2.5));   // 5 over V_p = 2
  CHECK(at(15, "speed") == Approx(1.0));  // 5 over V_p = 5
  CHECK(at(15, "z") == 4);
  CHECK(at(15, "replicate") == 2);
  CHECK(table.text(15, table.column("snapshot")) == "T7.5");
  CHECK(at(15, "base_height") == -0.5);
}

TEST_CASE("Without gravity a point has a nominal W and no other") {
  const SmallSweep small;
  const auto grid =
      small.grid("set: {lid.height: 10}\naxes: [{key: gravity, values: [0, 1]}]\nreplicates: 1\n");
  const Cache cache(small.folder.path() / "cache");
  make(sweeps::runs_of(grid), cache);
  const auto table = sweeps::collect(grid, cache).table;
  CHECK(std::isnan(table.number(0, table.column("W"))));
  CHECK(std::isnan(table.number(0, table.column("Gamma"))));
  CHECK(table.number(0, table.column("W_nominal")) == Approx(9));
  CHECK(table.number(1, table.column("W")) == Approx(9));
  CHECK(std::isnan(table.number(1, table.column("W_nominal"))));
}

}  // namespace
}  // namespace shakebed::tests
