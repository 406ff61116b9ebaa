#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/contact/parameters.hpp"
#include "simulator/scene/accuracy.hpp"
#include "simulator/simulate.hpp"
#include "tests/scenes/texts.hpp"

// A scene and seeds that had no part in the calibration.
namespace {

using namespace shakebed;
using namespace shakebed::simulator;

const std::vector<Override> small_flat_bed{
    {"dimension", "2"},          {"cell", "[5]"},
    {"grains.layers", "4"},      {"grains.restitution", "0.8"},
    {"base.restitution", "0.8"}, {"base.drive.W", "9"}};

std::vector<Override> with(std::vector<Override> more) {
  auto all = small_flat_bed;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Estimate T_z_of(const Record& record) {
  for (const auto& quantity : record.quantities) {
    if (quantity.name == "T_z") return quantity.estimate;
  }
  FAIL("no T_z");
  return {};
}

TEST_CASE("Promises of 2 % are kept on a scene and seeds they were not measured on") {
  Scene reference = tests::bed_with(
      with({{"protocol.measure.until", "{T_z: 0.4 %}"}, {"protocol.measure.at_most", "200000"}}));
  reference.contact.stiffness = 100 * automatic_stiffness(reference);
  const double truth = T_z_of(simulate(reference)).mean;

  // Kept with 95 % at least: P(X <= 8 of 12) is 2e-3, and 4e-4 for 97 % (the reference's own error
  // of 0.4 % is small beside 2 %).
  int kept = 0;
  for (int seed = 7001; seed <= 7012; ++seed) {
    const Scene scene =
        tests::bed_with(with({{"accuracy", "{T_z: 2 %}"}, {"seed", std::to_string(seed)}}));
    const Record record = simulate(scene);
    const auto reached = reached_accuracy(scene, record);
    REQUIRE(reached);
    CHECK(reached->met());
    CHECK(reached->reached() <= 0.02);
    kept += std::abs(T_z_of(record).mean / truth - 1) <= 0.02;
  }
  CHECK(kept >= 9);
}

}  // namespace
