#include "simulator/scene/read_scene.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::simulator;
using tests::bed_with;
using tests::rough_bed;
using tests::scene_of;

const std::filesystem::path scenes = std::filesystem::path(SHAKEBED_SOURCE_FOLDER) / "scenes";

TEST_CASE("The standard rough bed is read as written") {
  const Scene scene = read_scene(scenes / "rough_3d.yaml");
  CHECK(scene.dimension == 3);
  CHECK(scene.grains.count == 100);
  CHECK(scene.grains.layers == 4);
  CHECK(scene.grains.restitution == 0.9);
  CHECK(scene.grains.friction == 0.4);
  CHECK(scene.cell == std::vector<double>{5, 5});
  CHECK(scene.W() == Approx(22.36).epsilon(1e-14));
  CHECK(scene.Gamma() == Approx(22.36).epsilon(1e-14));
  CHECK(scene.contact.tangential == TangentialLaw::viscous_coulomb);
  CHECK(scene.contact.damping == TangentialDamping::as_normal);
  CHECK_FALSE(scene.contact.stiffness);
  CHECK_FALSE(scene.protocol.settle);
  CHECK_FALSE(scene.protocol.transient);
  CHECK(scene.protocol.cycles == 300);
  CHECK_FALSE(scene.protocol.until);
  CHECK(scene.protocol.time_step_fraction == 0.02);
  CHECK(scene.seed == 1);
}

TEST_CASE("Laboratory units come to W as the paper prints it") {
  // d = 5 mm, A = d, 300 ... 4000 rpm: W = (2 pi f A)^2/(d g) = 0.503 ... 89.43.
  const auto W = [](const char* rpm) {
    return read_scene(scenes / "smooth_2d.yaml", {{"base.drive.frequency_rpm", rpm}}).W();
  };
  CHECK(W("300") == Approx(0.503).epsilon(1e-3));
  CHECK(W("4000") == Approx(89.43).epsilon(1e-3));
  const Scene scene = read_scene(scenes / "smooth_2d.yaml");
  CHECK(scene.base.drive.amplitude == 1);
  CHECK(scene.grains.count == 40);
  CHECK(scene.protocol.until->quantity == "T_z");
  CHECK(scene.protocol.until->fraction == 0.03);
  CHECK(scene.protocol.transient == 100);
}

TEST_CASE("Defaults: the base is made like the grains, and measuring goes to 1 % of T_z") {
  const Scene scene = scene_of(tests::replaced(rough_bed, "{measure: {cycles: 300}}", "{}"),
                               {{"grains.friction", "0.2"}, {"grains.restitution", "0.8"}});
  CHECK(scene.base.restitution == 0.8);
  CHECK(scene.base.friction == 0.2);
  CHECK(scene.protocol.until->quantity == "T_z");
  CHECK(scene.protocol.until->fraction == 0.01);
  CHECK(scene.protocol.at_most == 20000);
  CHECK(scene.protocol.engine == Engine::automatic);
  CHECK(scene.gravity == 1);
}

TEST_CASE("Without a tangential law friction decides on one") {
  CHECK(bed_with({}).contact.tangential == TangentialLaw::frictionless);
  CHECK(bed_with({{"grains.friction", "0.4"}}).contact.tangential ==
        TangentialLaw::viscous_coulomb);
  CHECK(bed_with({{"base.friction", "0.4"}}).contact.tangential == TangentialLaw::viscous_coulomb);
}

TEST_CASE("A friction law without friction is the frictionless bed, to the byte") {
  const Scene scene = bed_with({{"contact.tangential", "{law: viscous_coulomb, damping: 3}"}});
  CHECK(scene.contact.tangential == TangentialLaw::frictionless);
  CHECK(canonical_yaml(scene) == canonical_yaml(bed_with({})));
}

TEST_CASE("Tangential damping is c_n, critical or a number") {
  const auto damping = [](const char* value) {
    return bed_with({{"base.friction", "0.1"},
                     {"contact.tangential",
                      std::string("{law: viscous_coulomb, damping: ") + value + "}"}})
        .contact;
  };
  CHECK(damping("c_n").damping == TangentialDamping::as_normal);
  CHECK(damping("critical").damping == TangentialDamping::critical);
  CHECK(damping("12.5").damping == TangentialDamping::value);
  CHECK(damping("12.5").damping_value == 12.5);
}

TEST_CASE("Layers and count are one thing") {
  const Scene scene = bed_with({{"grains.count", "40"}, {"dimension", "2"}, {"cell", "[10]"}});
  CHECK(scene.grains.layers == 4);  // N = count d/L_x
  CHECK(bed_with({{"grains.layers", "0.04"}}).grains.count == 1);
  // 16 digits of 600/12.25^2 come back to 600 grains although the product is not exact.
  const Scene round =
      bed_with({{"cell", "[12.25, 12.25]"}, {"grains.layers", "3.998334027488546"}});
  CHECK(round.grains.count == 600);
  CHECK(canonical_yaml(round) ==
        canonical_yaml(bed_with({{"cell", "[12.25, 12.25]"}, {"grains.count", "600"}})));
}

TEST_CASE("Physical lengths need and use the grain diameter") {
  const Scene scene = bed_with({{"units.diameter", "0.5 cm"},
                                {"cell_mm", "[25, 30]"},
                                {"grains.layers", "4"},
                                {"base.drive.amplitude_mm", "10"}});
  CHECK(scene.cell == std::vector<double>{5, 6});
  CHECK(scene.base.drive.amplitude == 2);
  CHECK(bed_with({{"grains.diameter_mm", "5"}, {"base.drive.amplitude_mm", "2.5"}})
            .base.drive.amplitude == 0.5);
}

TEST_CASE("Every unit of a quantity is worth what it says") {
  const auto amplitude = [](const char* diameter) {
    return bed_with({{"units.diameter", diameter}, {"base.drive.amplitude_mm", "5"}})
        .base.drive.amplitude;
  };
  CHECK(amplitude("5 mm") == 1);
  CHECK(amplitude("5mm") == 1);
  CHECK(amplitude("0.005 m") == Approx(1).epsilon(1e-15));
  CHECK(amplitude("0.5 cm") == Approx(1).epsilon(1e-15));
  CHECK(amplitude("5000 um") == 1);
  const auto omega = [](const char* gravity) {
    return bed_with({{"units", std::string("{diameter: 1 m, gravity: ") + gravity + "}"},
                     {"base.drive.frequency_hz", "1"}})
        .base.drive.angular_frequency;
  };
  CHECK(omega("1 m/s2") == Approx(2 * M_PI).epsilon(1e-15));
  CHECK(omega("100 cm/s2") == Approx(2 * M_PI).epsilon(1e-15));
}

TEST_CASE("A coarse time step is taken when it is asked for twice") {
  const std::string fraction = "protocol.time_step.fraction_of_contact_duration";
  CHECK(bed_with({{fraction, "0.2"}}).protocol.time_step_fraction == 0.2);
  const Scene coarse = bed_with({{fraction, "0.3"}, {"protocol.time_step.allow_coarse", "true"}});
  CHECK(coarse.protocol.time_step_fraction == 0.3);
  CHECK(coarse.protocol.allow_coarse_time_step);
  // Permission that is not used is not part of the bed.
  CHECK_FALSE(
      bed_with({{"protocol.time_step.allow_coarse", "true"}}).protocol.allow_coarse_time_step);
}

}  // namespace
