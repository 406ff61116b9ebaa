#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/architecture/rules.hpp"

using namespace shakebed::tests;

namespace {

constexpr int longest_file = 400;  // lines

std::string listed(const std::vector<Violation>& violations) {
  std::string text;
  for (const auto& violation : violations) text += violation + "\n";
  return text;
}

/// A small tree in which every room keeps the rules.
std::vector<Source> good_tree() {
  return {
      {"files/csv.hpp", "#include <string>\n"},
      {"simulator/record.hpp", "#include <vector>\n"},
      {"simulator/simulate.cpp",
       "#include \"simulator/record.hpp\"\n#include <Eigen/Core>\n#include <experimental/simd>\n"},
      {"sweeps/store/cache.hpp", "#include <hdf5.h>\n#include \"simulator/record.hpp\"\n"},
      {"sweeps/ensemble.cpp", "#include \"sweeps/store/cache.hpp\"\n#include <tbb/task_group.h>\n"},
      {"fitting/fit.cpp", "#include <gsl/gsl_fit.h>\n#include \"files/csv.hpp\"\n"},
      {"figures/figure.hpp", "#include \"files/csv.hpp\"\n"},
      {"cli/arguments.cpp", "#include \"figures/figure.hpp\"\n#include <CLI/CLI.hpp>\n"},
      {"tests/fitting/test_fit.cpp", "#include <catch2/catch.hpp>\n"},
  };
}

struct Planted {
  std::string path;
  std::string include;
};

std::vector<Closure> read_closures(const std::string& file) {
  std::ifstream stream(file);
  REQUIRE(stream);
  std::vector<Closure> closures;
  std::string line;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    Closure closure;
    words >> closure.target;
    for (std::string link; words >> link;) closure.links.push_back(link);
    closures.push_back(closure);
  }
  return closures;
}

}  // namespace

TEST_CASE("every room includes only what its place allows") {
  const auto tree = read_sources(SHAKEBED_SOURCE_FOLDER);
  REQUIRE(tree.size() > 20);  // a wrong folder would pass every rule
  CHECK(listed(include_violations(tree)) == "");
}

TEST_CASE("no source is longer than a reader's patience") {
  CHECK(listed(length_violations(read_sources(SHAKEBED_SOURCE_FOLDER), longest_file)) == "");
}

TEST_CASE("no library reaches up, or for a package of another room") {
  // Networks and fits are libraries of one room.
  const std::vector<Forbidden> forbidden = {
      {"shakebed_files", "shakebed_simulator"},
      {"shakebed_files", "shakebed_store"},
      {"shakebed_simulator", "shakebed_store"},
      {"shakebed_simulator", "shakebed_sweeps"},
      {"shakebed_simulator", "shakebed_fitting"},
      {"shakebed_simulator", "tbb"},
      {"shakebed_simulator", "hdf5"},

      {"shakebed_simulator", "gsl"},
      {"shakebed_store", "shakebed_simulator"},
      {"shakebed_store", "shakebed_sweeps"},
      {"shakebed_store", "tbb"},
      {"shakebed_sweeps", "shakebed_fitting"},
      {"shakebed_sweeps", "gsl"},
      {"shakebed_fitting", "shakebed_simulator"},
      {"shakebed_fitting", "shakebed_sweeps"},
      {"shakebed_fitting", "tbb"},
      {"shakebed_networks", "shakebed_simulator"},
      {"shakebed_networks", "shakebed_sweeps"},
      {"shakebed_networks", "tbb"},
      {"shakebed_figures", "shakebed_simulator"},
      {"shakebed_figures", "shakebed_sweeps"},
  };
  CHECK(listed(link_violations(read_closures(SHAKEBED_LINK_CLOSURES), forbidden)) == "");
}

TEST_CASE("the include rules see a planted violation") {
  REQUIRE(listed(include_violations(good_tree())) == "");
  const std::vector<Planted> violations = {
      {"files/yaml.cpp", "\"simulator/record.hpp\""},
      {"simulator/bed.cpp", "\"sweeps/store/cache.hpp\""},
      {"simulator/bed.cpp", "<tbb/parallel_for.h>"},
      {"simulator/bed.cpp", "<hdf5.h>"},
      {"simulator/scene/read_scene.cpp", "<yaml-cpp/yaml.h>"},
      {"sweeps/store/table.cpp", "<tbb/mutex.h>"},
      {"sweeps/store/table.cpp", "\"simulator/simulate.hpp\""},
      {"sweeps/grid.cpp", "<hdf5.h>"},
      {"sweeps/grid.cpp", "<gsl/gsl_rng.h>"},
      {"fitting/peak.cpp", "<tbb/task_arena.h>"},
      {"fitting/peak.cpp", "\"sweeps/ensemble.hpp\""},
      {"fitting/peak.cpp", "<hdf5.h>"},
      {"fitting/peak.cpp", "\"sweeps/store/cache.hpp\""},
      {"fitting/peak.cpp", "\"sweeps/store/hdf5.hpp\""},
      {"fitting/networks/snapshot.cpp", "<hdf5.h>"},
      {"figures/report.cpp", "\"simulator/record.hpp\""},
      {"figures/report.cpp", "<gsl/gsl_fit.h>"},
      {"cli/run.cpp", "<CLI/CLI.hpp>"},
      {"cli/run.cpp", "<hdf5.h>"},
      {"cli/run.cpp", "\"tests/helper.hpp\""},
      {"fitting/fit.hpp", "<catch2/catch.hpp>"},
      {"fitting/fit.hpp", "\"measurements.hpp\""},  // not by its path from the root
      {"fitting/fit.hpp", "\"../files/csv.hpp\""},
      {"new_room/thing.cpp", "<vector>"},
  };
  for (const auto& planted : violations) {
    CAPTURE(planted.path, planted.include);
    auto tree = good_tree();
    for (const char* other : {"simulator/simulate.hpp", "sweeps/ensemble.hpp", "tests/helper.hpp",
                              "sweeps/store/hdf5.hpp"}) {
      tree.push_back({other, ""});
    }
    tree.push_back({planted.path, "\n  #  include " + planted.include + "  // why\n"});
    CHECK(include_violations(tree).size() == 1);
  }
}

TEST_CASE("the length rule sees one line too many") {
  const std::vector<Source> tree = {{"files/a.cpp", std::string(400, '\n')},
                                    {"files/b.cpp", std::string(401, '\n')}};
  CHECK(listed(length_violations(tree, longest_file)) == "files/b.cpp: 401 lines, more than 400\n");
}

TEST_CASE("the link rules see a planted link, and a target that is not there") {
  const std::vector<Closure> closures = {{"shakebed_fitting", {"GSL::gsl", "TBB::tbb"}}};
  CHECK(listed(link_violations(closures, {{"shakebed_fitting", "tbb"}})) ==
        "shakebed_fitting links TBB::tbb\n");
  CHECK(link_violations(closures, {{"shakebed_fitting", "hdf5"}}).empty());
  CHECK(link_violations(closures, {{"shakebed_store", "tbb"}}).size() == 1);
}
