#include <catch2/catch.hpp>

#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::simulator;
using tests::bed_with;
using tests::faults_of;
using tests::replaced;
using tests::rough_bed;
using tests::scene_of;

const std::string two_rates =
    replaced(rough_bed, "{W: 22.36, amplitude: 1}", "{W: 8, Gamma: 4}");  // A = 2

TEST_CASE("A rate set replaces the scene's rate and keeps its amplitude") {
  CHECK(bed_with({{"base.drive.W", "9"}}).base.drive.angular_frequency == 3);
  CHECK(bed_with({{"base.drive.Gamma", "9"}}).base.drive.angular_frequency == 3);
  CHECK(bed_with({{"base.drive.angular_frequency", "3"}}).base.drive.angular_frequency == 3);
  CHECK(bed_with({{"base.drive.Gamma", "9"}}).base.drive.amplitude == 1);
  const auto rpm = bed_with({{"units.diameter", "5 mm"}, {"base.drive.frequency_rpm", "300"}});
  CHECK(rpm.W() == Approx(0.503).epsilon(1e-3));
}

TEST_CASE("An amplitude set replaces the amplitude and keeps the rate") {
  const Scene scene = bed_with({{"base.drive.amplitude", "2"}});
  CHECK(scene.base.drive.amplitude == 2);
  CHECK(scene.W() == Approx(22.36).epsilon(1e-14));
  const Scene mm = bed_with({{"units.diameter", "5 mm"}, {"base.drive.amplitude_mm", "2.5"}});
  CHECK(mm.base.drive.amplitude == 0.5);
  CHECK(mm.W() == Approx(22.36).epsilon(1e-14));
}

TEST_CASE("Two drive keys set both count, whatever the scene had") {
  const Scene rates = bed_with({{"base.drive.W", "8"}, {"base.drive.Gamma", "4"}});
  CHECK(rates.base.drive.amplitude == 2);
  const Scene both = scene_of(two_rates, {{"base.drive.amplitude", "3"}, {"base.drive.W", "9"}});
  CHECK(both.base.drive.amplitude == 3);
  CHECK(both.base.drive.angular_frequency == 1);
}

TEST_CASE("One key of a scene with two rates replaces its like, or must not be guessed") {
  CHECK(scene_of(two_rates, {{"base.drive.W", "16"}}).base.drive.amplitude == 4);
  const auto faults = faults_of(two_rates, {{"base.drive.amplitude", "3"}});
  REQUIRE(faults.size() == 1);
  CHECK_THAT(faults[0].what, Catch::Contains("exactly two") && Catch::Contains("W, Gamma, ampl"));
}

TEST_CASE("The later of two settings of one key counts") {
  CHECK(bed_with({{"seed", "2"}, {"seed", "3"}}).seed == 3);
  CHECK(bed_with({{"base.drive.W", "4"}, {"base.drive.W", "9"}}).base.drive.angular_frequency == 3);
  CHECK(bed_with({{"base.drive.W", "4"}, {"base.drive", "{amplitude: 3, W: 9}"}})
            .base.drive.amplitude == 3);
}

TEST_CASE("Equivalent keys replace each other") {
  CHECK(bed_with({{"grains.count", "50"}}).grains.layers == 2);
  CHECK(bed_with({{"grains.count", "50"}, {"grains.layers", "3"}}).grains.count == 75);
  CHECK(bed_with({{"units.diameter", "5 mm"}, {"cell_mm", "[50, 50]"}}).cell[0] == 10);
  CHECK(bed_with({{"units.diameter", "5 mm"}, {"grains.diameter_mm", "1"}, {"cell_mm", "[5, 5]"}})
            .cell[0] == 5);

  const auto until = bed_with({{"protocol.measure.until.T", "2 %"}}).protocol;
  CHECK_FALSE(until.cycles);
  CHECK(until.until->quantity == "T");
  CHECK(bed_with({{"protocol.measure.until.T", "2 %"}, {"protocol.measure.until.T_z", "3 %"}})
            .protocol.until->quantity == "T_z");
  const auto cycles = bed_with({{"protocol.measure", "{until: {T: 2 %}, at_most: 50}"},
                                {"protocol.measure.cycles", "7"}})
                          .protocol;
  CHECK(cycles.cycles == 7);
  CHECK_FALSE(cycles.until);
}

TEST_CASE("A key below a word takes the word's place") {
  CHECK(scene_of(replaced(rough_bed, "{measure", "{transient: auto, measure"),
                 {{"protocol.transient.cycles", "1e3"}})
            .protocol.transient == 1000);
  CHECK(bed_with({{"protocol.transient.cycles", "5"}, {"protocol.transient", "auto"}})
            .protocol.transient == std::nullopt);
}

TEST_CASE("Faults of a setting are placed at the setting, or where its caller says") {
  const auto faults =
      faults_of(rough_bed, {{"grains.friction", "-1"}, {"grains.friktion", "1", "sweep.yaml:4:7"}});
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].where == "--set grains.friction=-1");
  CHECK(faults[1].where == "sweep.yaml:4:7");
  CHECK(faults[1].what == "unknown key `grains.friktion`; did you mean `friction`?");
  CHECK(faults_of(rough_bed, {{"cell", "[1"}})[0].where == "--set cell=[1");
}

}  // namespace
