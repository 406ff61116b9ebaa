#include <catch2/catch.hpp>
#include <map>

#include "sweeps/grid.hpp"

namespace shakebed::tests {
namespace {

const std::filesystem::path sweep =
    std::filesystem::path(SHAKEBED_SWEEPS_FOLDER) / "bhateja2016" / "canonical.yaml";

TEST_CASE(
    "The canonical sweep is the paper's: 38 frequencies and ten beyond them, in four systems") {
  const auto grid = sweeps::read_grid(sweep, "paper");
  REQUIRE(grid.points.size() == 4 * 48);
  CHECK(grid.points.back().scene.W() > 135);  // the end of Feitosa & Menon's range
  CHECK(grid.columns[0].name == "system");
  CHECK(grid.columns[1].name == "frequency_rpm");
  for (const auto& point : grid.points) {
    const auto& scene = point.scene;
    const bool flat = point.labels[0].starts_with("2D");
    const bool rough = point.labels[0].ends_with("rough");
    CHECK(scene.dimension == (flat ? 2 : 3));
    CHECK(scene.grains.count == (flat ? 40 : 100));
    CHECK(scene.cell == (flat ? std::vector<double>{10} : std::vector<double>{5, 5}));
    CHECK(scene.grains.friction == (rough ? 0.4 : 0));
    CHECK(scene.base.friction == (rough ? 0.4 : 0));
    CHECK(scene.grains.restitution == 0.9);
    CHECK(scene.base.restitution == 0.9);
    CHECK(scene.base.drive.amplitude == 1);
    CHECK((scene.contact.tangential == simulator::TangentialLaw::viscous_coulomb) == rough);
  }
  // Printed in the paper: W = 0.89, 4.52, 5.58, 8.04, 22.35, 50.3, 68.46, 85.01 at these rpm. It
  // cuts its third digit off (22.36 is printed as 22.35), so the last digit may differ by one.
  const std::map<std::string, double> printed{{"400", 0.89},   {"900", 4.52},   {"1000", 5.58},
                                              {"1200", 8.04},  {"2000", 22.35}, {"3000", 50.3},
                                              {"3500", 68.46}, {"3900", 85.01}};
  for (const auto& point : grid.points) {
    const auto found = printed.find(point.labels[1]);
    if (found != printed.end()) CHECK(point.scene.W() == Approx(found->second).margin(0.0151));
  }
}

TEST_CASE("The quick profile keeps all systems and the points that carry the shape") {
  const auto grid = sweeps::read_grid(sweep, "quick");
  std::map<std::string, int> points;
  int near_the_peak = 0;
  for (const auto& point : grid.points) {
    ++points[point.labels[0]];
    near_the_peak += point.labels[0] == "3D rough" && point.scene.W() > 1 && point.scene.W() < 9;
  }
  CHECK(points.size() == 4);
  for (const auto& [system, count] : points) CHECK(count >= 14);
  CHECK(near_the_peak >= 6);
}

}  // namespace
}  // namespace shakebed::tests
