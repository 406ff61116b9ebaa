#include "sweeps/grid.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "files/error.hpp"
#include "tests/sweeps/small_sweep.hpp"

namespace shakebed::tests {
namespace {

std::vector<std::string> descriptions(const sweeps::Grid& grid) {
  std::vector<std::string> texts;
  for (const auto& point : grid.points) texts.push_back(grid.describe(point));
  return texts;
}

using Texts = std::vector<std::string>;

TEST_CASE("Axes are crossed, the last one fastest") {
  const SmallSweep small;
  const auto grid = small.grid(
      "axes:\n"
      "  - {key: grains.restitution, values: [0.5, 0.9], as: e_p}\n"
      "  - {key: base.drive.W, range: {from: 2, to: 6, step: 2}}\n");
  CHECK(descriptions(grid) == Texts{"e_p = 0.5, W = 2", "e_p = 0.5, W = 4", "e_p = 0.5, W = 6",
                                    "e_p = 0.9, W = 2", "e_p = 0.9, W = 4", "e_p = 0.9, W = 6"});
  CHECK(grid.points[2].scene.grains.restitution == 0.5);
  CHECK(grid.points[2].scene.W() == Approx(6).epsilon(1e-12));
  CHECK(grid.points[2].scene.base.drive.amplitude == 1);
  CHECK(grid.columns[0].name == "e_p");
  CHECK(grid.columns[1].unit == "1");
}

TEST_CASE("Ranges: steps reach their end, rpm turn into W, logarithmic spacing") {
  const SmallSweep small;
  const auto tenths =
      small.grid("axes: [{key: base.drive.amplitude, range: {from: 0.1, to: 1, step: 0.1}}]\n");
  REQUIRE(tenths.points.size() == 10);
  CHECK(tenths.points[2].labels[0] == "0.3");
  CHECK(tenths.points[9].scene.base.drive.amplitude == 1);
  CHECK(small.grid("axes: [{key: base.drive.W, range: {from: 5, to: 1, step: -2}}]\n")
            .points.size() == 3);

  const auto rpm = small.grid(
      "axes: [{key: base.drive.frequency_rpm, range: {from: 300, to: 4000, step: 100}}]\n");
  REQUIRE(rpm.points.size() == 38);
  CHECK(rpm.columns[0].unit == "rpm");
  // W = d omega^2/g at A = d = 5 mm: 0.503 at 300 rpm, 89.43 at 4000.
  CHECK(rpm.points.front().scene.W() == Approx(0.503).epsilon(1e-3));
  CHECK(rpm.points.back().scene.W() == Approx(89.43).epsilon(1e-4));

  const auto log = small.grid(
      "axes: [{key: base.drive.W, range: {from: 1, to: 1000, count: 4, spacing: log}}]\n");
  CHECK(descriptions(log) == Texts{"W = 1", "W = 10", "W = 100", "W = 1000"});
  const auto linear =
      small.grid("axes: [{key: base.drive.W, range: {from: 1, to: 2, count: 3}}]\n");
  CHECK(descriptions(linear) == Texts{"W = 1", "W = 1.5", "W = 2"});
}

TEST_CASE("Zipped axes step together and cross with the others") {
  const SmallSweep small;
  const auto grid = small.grid(
      "axes:\n"
      "  - {key: seed, values: [7]}\n"
      "  - zip:\n"
      "      - {key: base.drive.W, values: [1, 4]}\n"
      "      - {key: base.drive.amplitude, values: [0.5, 1]}\n");
  CHECK(descriptions(grid) ==
        Texts{"seed = 7, W = 1, amplitude = 0.5", "seed = 7, W = 4, amplitude = 1"});
  CHECK(grid.points[0].scene.W() == Approx(1));
  CHECK(grid.points[0].scene.base.drive.amplitude == 0.5);
}

TEST_CASE("Cases are named bundles of keys; lists are one cell") {
  const SmallSweep small;
  const auto grid = small.grid(
      "axes:\n"
      "  - cases: system\n"
      "    values:\n"
      "      2D: {}\n"
      "      3D: {dimension: 3, cell: [4, 4], grains.layers: 3}\n"
      "  - {key: base.drive.W, values: [2]}\n");
  CHECK(descriptions(grid) == Texts{"system = 2D, W = 2", "system = 3D, W = 2"});
  CHECK(grid.columns[0].unit.empty());
  CHECK(grid.points[1].scene.dimension == 3);
  CHECK(grid.points[1].scene.grains.count == 48);

  const auto cells = small.grid("axes: [{key: cell, values: [[5], [10]]}]\n");
  CHECK(descriptions(cells) == Texts{"cell = 5", "cell = 10"});
  CHECK(cells.points[1].scene.cell == std::vector<double>{10});
}

const std::string with_profiles =
    "set: {protocol.measure.cycles: 50}\n"
    "axes:\n"
    "  - {key: base.drive.W, range: {from: 1, to: 5, step: 1}}\n"
    "  - {cases: kind, values: {hard: {grains.restitution: 0.9}, soft: {grains.restitution: "
    "0.5}}}\n"
    "replicates: 4\n"
    "profiles:\n"
    "  quick:\n"
    "    set: {protocol.measure.until: {T_z: 4 %}, protocol.measure.at_most: 70}\n"
    "    axes: {W: [2, 3.5], kind: [soft]}\n"
    "    replicates: 2\n"
    "  range: {axes: {W: {from: 2, to: 3, step: 0.5}}}\n"
    "  paper: {}\n"
    "  pointed:\n"
    "    set: {protocol.measure.cycles: 60}\n"
    "    points:\n"
    "      - {where: {W: [2, 4], kind: [hard]}, set: {protocol.measure.cycles: 7}}\n";

TEST_CASE("Keys of single points go over those of the profile, at these points alone") {
  const SmallSweep small;
  for (const auto& point : small.grid(with_profiles, "pointed").points) {
    const bool meant =
        (point.labels[0] == "2" || point.labels[0] == "4") && point.labels[1] == "hard";
    CHECK(point.scene.protocol.cycles == (meant ? 7 : 60));
  }
}

TEST_CASE("A profile sets keys, narrows axes and chooses replicates") {
  const SmallSweep small;
  const auto quick = small.grid(with_profiles, "quick");
  CHECK(descriptions(quick) == Texts{"W = 2, kind = soft", "W = 3.5, kind = soft"});
  CHECK(quick.replicates == 2);
  CHECK_FALSE(quick.points[0].scene.protocol.cycles);
  CHECK(quick.points[0].scene.protocol.until->fraction == 0.04);
  CHECK(quick.points[0].scene.protocol.at_most == 70);
  const auto paper = small.grid(with_profiles, "paper");
  CHECK(paper.points.size() == 10);
  CHECK(paper.replicates == 4);
  CHECK(paper.points[0].scene.protocol.cycles == 50);
  CHECK(small.grid(with_profiles, "range").points.size() == 6);
}

TEST_CASE("A sweep without profiles is the same under any") {
  const SmallSweep small;
  CHECK(small.grid("axes: [{key: base.drive.W, values: [1]}]\n", "paper").points.size() == 1);
}

TEST_CASE("Faults of a sweep are refused with their place") {
  const SmallSweep small;
  const std::string head = (small.folder.path() / "sweep.yaml").string();
  const auto refused = [&](const std::string& body, const std::string& place,
                           const std::string& what, const std::string& profile = "quick") {
    INFO(body);
    try {
      small.grid(body, profile);
      FAIL_CHECK("was read");
    } catch (const files::Error& error) {
      CHECK(error.kind() == files::Error::Kind::bad_input);
      CHECK_THAT(error.what(), Catch::Contains(head + place));
      CHECK_THAT(error.what(), Catch::Contains(what));
    }
  };
  refused("axes: []\nreplicate: 3\n", ":5:1", "replicates");
  refused("axes: [{key: base.drive.WW, values: [1]}]\n", ":4:", "WW");
  refused("axes:\n  - {key: grains.restitution, values: [0.9, 0.5, 1.5]}\n", ":5:50", "1.5");
  refused("axes: [{key: base.drive.W}]\n", ":4:8", "`values` or `range`");
  refused("axes: [{key: base.drive.W, values: []}]\n", ":4:", "at least one");
  refused("axes: [{key: base.drive.W, range: {from: 1, to: 5, step: -1}}]\n", ":4:", "step");
  refused("axes: [{key: base.drive.W, range: {from: 1, to: 5, step: 0}}]\n", ":4:", "step");
  refused("axes: [{key: base.drive.W, range: {from: 0, to: 5, count: 3, spacing: log}}]\n",
          ":4:", "positive");
  refused("axes: [{key: base.drive.W, range: {from: 0, to: 1, step: 1e-9}}]\n", ":4:", "1 to");
  refused(
      "axes:\n  - zip:\n      - {key: base.drive.W, values: [1, 2]}\n"
      "      - {key: base.drive.amplitude, values: [1]}\n",
      ":7:9", "the first has 2, this one 1");
  refused("axes: [{key: base.drive.W, values: [1]}, {key: base.drive.W, values: [2]}]\n",
          ":4:", "column `W`");
  refused("axes: [{key: base.drive.W, values: [1]}]\nreplicates: 0\n", ":", "replicates");
  refused("axes: [{key: seed, values: [1, 2]}]\nreplicates: 2\n", ":", "seed");
  refused(with_profiles, ":10:", "quick, range, paper, pointed", "medium");
  refused("axes: [{key: base.drive.W, values: [1]}]\nprofiles: {quick: {axes: {V: [1]}}}\n",
          ":5:", "V");
  refused(
      "axes:\n  - {cases: kind, values: {hard: {}, soft: {}}}\n"
      "profiles: {quick: {axes: {kind: [sofd]}}}\n",
      ":6:", "did you mean `soft`");
  const auto pointed = [&](const std::string& where, const std::string& what) {
    refused(
        "axes: [{key: base.drive.W, values: [1, 2]}]\n"
        "profiles: {quick: {points: [{where: " +
            where + ", set: {gravity: 2}}]}}\n",
        ":5:", what);
  };
  pointed("{W: [3]}", "no point of this profile has W = 3; there are 1, 2");
  pointed("{w: [1]}", "did you mean `W`");
  pointed("{}", "at least one column");
  refused(
      "axes:\n"
      "  - {key: base.drive.W, range: {from: 1, to: 1000, step: 1}}\n"
      "  - {key: grains.restitution, range: {from: 0.1, to: 1, count: 1000}}\n",
      "", "more than 100000");
}

TEST_CASE("Faults of the scene are said once, with the first point that has them") {
  const SmallSweep small;
  try {
    // 2.2 layers on 5 d are 11 grains; 2.5 layers are 12.5.
    small.grid(
        "axes:\n  - {key: grains.layers, values: [2.2, 2.5]}\n"
        "  - {key: base.drive.W, values: [1, 2, 3]}\n");
    FAIL("was read");
  } catch (const files::Error& error) {
    CHECK(error.faults().size() == 1);
    CHECK_THAT(error.what(), Catch::Contains("at the point layers = 2.5, W = 1"));
  }
  const auto missing = small.folder.path() / "other.yaml";
  files::write_text(missing, "sweep: 1\nid: x\nbase: absent.yaml\naxes: []\n");
  CHECK_THROWS_WITH(sweeps::read_grid(missing, "quick"), Catch::Contains("absent.yaml"));
  files::write_text(missing, "sweep: 2\nid: x\nbase: scene.yaml\naxes: []\n");
  CHECK_THROWS_WITH(sweeps::read_grid(missing, "quick"),
                    Catch::Contains(":1:8") && Catch::Contains("schema 1"));
}

/// Seeds by point and replicate, however the grid is ordered.
std::map<std::string, std::uint64_t> seeds_of(const sweeps::Grid& grid) {
  std::map<std::string, std::uint64_t> seeds;
  for (const auto& run : sweeps::runs_of(grid)) {
    const auto& scene = grid.points[run.point].scene;
    seeds[simulator::canonical_yaml(scene) + "#" + std::to_string(run.replicate)] = run.scene.seed;
  }
  return seeds;
}

TEST_CASE("A replicate's seed depends on its point alone") {
  const SmallSweep small;
  const std::string e = "  - {key: grains.restitution, values: [0.5, 0.9]}\n";
  const std::string few = "  - {key: base.drive.W, values: [1, 2]}\n";
  const std::string more = "  - {key: base.drive.W, values: [4, 2, 1, 3]}\n";
  const auto first = seeds_of(small.grid("axes:\n" + e + few + "replicates: 3\n"));
  const auto reordered = seeds_of(small.grid("axes:\n" + few + e + "replicates: 3\n"));
  const auto extended = seeds_of(small.grid("axes:\n" + more + e + "replicates: 5\n"));
  CHECK(first == reordered);
  CHECK(extended.size() == 40);
  CHECK(std::includes(extended.begin(), extended.end(), first.begin(), first.end()));

  std::set<std::uint64_t> distinct;
  for (const auto& [run, seed] : extended) {
    distinct.insert(seed);
    CHECK(seed < (std::uint64_t{1} << 53));
  }
  CHECK(distinct.size() == extended.size());

  const auto other_base = seeds_of(small.grid("set: {seed: 2}\naxes:\n" + e + few));
  for (const auto& [run, seed] : other_base) CHECK(distinct.count(seed) == 0);
}

TEST_CASE("An axis over seeds uses them as they are") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(small.grid("axes: [{key: seed, values: [3, 5]}]\n"));
  CHECK(runs[0].scene.seed == 3);
  CHECK(runs[1].scene.seed == 5);
}

TEST_CASE("A run's canonical scene reads back as its scene, with its key") {
  const SmallSweep small;
  const auto runs = sweeps::runs_of(
      small.grid("axes: [{key: base.drive.frequency_rpm, values: [300, 1300]}]\nreplicates: 2\n"));
  std::set<std::string> keys;
  for (const auto& run : runs) {
    const auto scene = simulator::read_scene(
        files::YamlNode::load_text(run.identity.canonical_scene, "canonical"));
    CHECK(simulator::canonical_yaml(scene) == run.identity.canonical_scene);
    CHECK(scene.seed == run.scene.seed);
    keys.insert(run.identity.key);
  }
  CHECK(keys.size() == runs.size());
}

}  // namespace
}  // namespace shakebed::tests
