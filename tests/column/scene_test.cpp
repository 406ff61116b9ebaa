#include <catch2/catch.hpp>
#include <numbers>

#include "simulator/contact/column_parameters.hpp"
#include "simulator/scene/column.hpp"
#include "tests/column/scene_text.hpp"

namespace {

using namespace shakebed;
using simulator::Override;
using tests::small_column;

std::string faults_of(const std::vector<Override>& overrides) {
  try {
    small_column(overrides);
  } catch (const files::Error& error) {
    return error.what();
  }
  return "no fault";
}

}  // namespace

TEST_CASE("A scene with a container says what its contacts are") {
  const auto scene = small_column();
  REQUIRE(scene.column);
  const auto& column = *scene.column;
  CHECK(column.diameter == 5);
  CHECK(column.has_large);
  CHECK(column.large_density == Approx(13.54 / (6 / std::numbers::pi)));
  CHECK(column.grain.normal_stiffness == 2e5);
  CHECK(column.grain.tangential_stiffness == Approx(2e5 * 2 / 7));
  CHECK(column.grain.tangential_rate == 0);
  CHECK(column.wall.tangential_rate == 20);
  CHECK(column.wall.normal_rate == 40);
  CHECK(column.wall.friction == 0.5);  // as between grains unless said otherwise
  CHECK(scene.cell_area() == Approx(25 * std::numbers::pi / 4));
}

TEST_CASE("Lengths in mm and ratios come to the same bed") {
  const auto scene = small_column({{"units.diameter", "2 mm"},
                                   {"container", "{cylinder: {diameter_mm: 10}}"},
                                   {"container.wall.gamma_t", "20"},
                                   {"grains.large", "{diameter_mm: 4, density_ratio: 7.09}"}});
  CHECK(scene.column->diameter == 5);
  CHECK(scene.column->large_diameter == 2);
  CHECK(scene.column->large_density == 7.09);
}

TEST_CASE("The canonical text of a bed in a container reads back as itself") {
  for (const auto& overrides : std::vector<std::vector<Override>>{
           {},
           {{"contact.normal", "hertz"}, {"container.frame", "co_moving"}},
           {{"grains.sizes", "[0.9, 1.1]"}, {"drag", "{background: 0.24}"}},
           {{"contact.tangential.stiffness_ratio", "0.3"}, {"container.wall.stiffness", "3e5"}},
           {{"protocol.time_step", "{fraction_of_contact_duration: 0.02}"}},
           {{"protocol.measure.cycles", "12"}, {"protocol.contact_velocities", "half_step"}},
           {{"protocol.measure.cycles", "12"}, {"protocol.snapshots", "{phases: []}"}},
           {{"protocol.list_skin", "0.7"}},
           {{"grains.large", "{diameter: 2.5, density_ratio: 3}"}, {"seed", "9"}}}) {
    const auto scene = small_column(overrides);
    const std::string text = simulator::canonical_yaml(scene);
    const auto back = simulator::read_scene(files::YamlNode::load_text(text, "canonical"));
    CHECK(simulator::canonical_yaml(back) == text);
    const auto p = simulator::bind_column(scene);
    const auto q = simulator::bind_column(back);
    CHECK(p.time_step == q.time_step);
    CHECK(p.kinds.front().spring.tangential_stiffness ==
          q.kinds.front().spring.tangential_stiffness);
  }
}

TEST_CASE("A step above t_c/20 is refused however it is given, one at it is not") {
  const auto refused = [](const std::string& time_step) {
    try {
      small_column({{"protocol.time_step", time_step}});
    } catch (const files::Error&) {
      return true;
    }
    return false;
  };
  CHECK(refused("{fraction_of_contact_duration: 0.051}"));
  CHECK_FALSE(refused("{fraction_of_contact_duration: 0.05}"));
  CHECK_FALSE(refused("{fraction_of_contact_duration: 0.06, allow_coarse: true}"));
  const double t_c = simulator::bind_column(small_column()).contact_duration;
  CHECK(refused("{value: " + std::to_string(0.051 * t_c) + "}"));
  CHECK_FALSE(refused("{value: " + std::to_string(0.0495 * t_c) + "}"));
}

TEST_CASE("Beds are shared by scenes that differ in drive, drag or length, and by no others") {
  const std::string text = simulator::preparation_text(small_column());
  CHECK(text == simulator::preparation_text(small_column({{"drag.background", "0.24"},
                                                          {"base.drive.amplitude", "2"},
                                                          {"container.frame", "co_moving"},
                                                          {"protocol.measure.cycles", "5"}})));
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"container.wall.friction", "0"},
                                                        {"contact.stiffness", "1e5"},
                                                        {"contact.normal", "hertz"},
                                                        {"grains.sizes", "[0.9, 1.1]"},
                                                        {"grains.count", "61"},
                                                        {"protocol.prepare.Gamma", "3"},
                                                        {"seed", "2"}}) {
    CHECK(text != simulator::preparation_text(small_column({{key, value}})));
  }
}

TEST_CASE("Packings, which know no friction, are shared by scenes that differ in it") {
  const std::string text = simulator::pouring_text(small_column());
  CHECK(text == simulator::pouring_text(small_column({{"container.wall.friction", "0"},
                                                      {"grains.friction", "0.1"},
                                                      {"container.wall.gamma_t", "3"},
                                                      {"contact.tangential.gamma_t", "7"},
                                                      {"contact.tangential.stiffness_ratio", "1"},
                                                      {"drag.air", "0.01"}})));
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"container.cylinder.diameter", "6"},
                                                        {"container.wall.gamma_n", "50"},
                                                        {"contact.gamma_n", "50"},
                                                        {"grains.large.density", "13"},
                                                        {"contact.stiffness", "1e5"},
                                                        {"contact.normal", "hertz"},
                                                        {"protocol.prepare.frequency", "3"},
                                                        {"protocol.prepare.kinetic_energy", "1e-7"},
                                                        {"seed", "2"}}) {
    CHECK(text != simulator::pouring_text(small_column({{key, value}})));
  }
}

TEST_CASE("Snapshots are of cycle 10 in 20 phases unless the scene says otherwise") {
  const auto scene = small_column({{"protocol.measure.cycles", "11"}});
  CHECK(scene.protocol.snapshots.phases.size() == 20);
  CHECK(scene.protocol.snapshots.from_cycle == 10);
  CHECK(small_column().protocol.snapshots.phases.empty());
  CHECK(small_column({{"protocol.measure.cycles", "12"}, {"protocol.snapshots", "{phases: []}"}})
            .protocol.snapshots.phases.empty());
}

TEST_CASE("160 equal phases divide a cycle, with about the step asked for") {
  const auto scene = small_column({{"base.drive.frequency", "0.107"}});
  const auto p = simulator::bind_column(scene);
  CHECK(p.steps_per_cycle == 46720);
  CHECK(p.time_step == Approx(2e-4).epsilon(3e-4));
}

TEST_CASE("What does not fit in a container is refused, with what to do") {
  struct Fault {
    std::vector<Override> overrides;
    std::string says;
  };
  for (const auto& [overrides, says] : std::vector<Fault>{
           {{{"grains.large.diameter", "4.5"}}, "no room for a small one beside it"},
           {{{"container.cylinder.diameter", "1.5"}}, "in [2, 1000] d"},
           {{{"container.cylinder.diameter", "2.1"}, {"grains.sizes", "[1, 1.1]"}},
            "narrower than two grains"},
           {{{"contact.stiffness", "2e6"}}, "write at most 6.28e-05"},
           {{{"contact.stiffness", "auto"}}, "must be a number in a container"},
           {{{"contact.tangential", "{law: viscous_coulomb}"}}, "cundall_strack"},
           {{{"contact.tangential", "frictionless"}}, "friction: 0"},
           {{{"grains.restitution", "0.9"}}, "means nothing to a bed in a container"},
           {{{"grains.sizes", "[1.1, 0.9]"}}, "[smallest, largest]"},
           {{{"protocol.engine", "events"}}, "auto or uniform"},
           {{{"protocol.measure", "{until: {T_z: 1 %}}"}}, "measure: {cycles: 40}"},
           {{{"protocol.snapshots", "{phases: [0], from_cycle: 5}"}}, "only 2 are run"},
           {{{"container.cylinder", "{diameter_mm: 10}"}}, "units: {diameter: 2 mm}"},
           {{{"grains.large.density_ratio", "2"}}, "keep one"}}) {
    INFO(says);
    CHECK_THAT(faults_of(overrides), Catch::Contains(says));
  }
}

TEST_CASE("A large grain too heavy for its contacts is refused") {
  // M (1 + Gamma)/k_n = 0.5 with Gamma = (2 pi 0.3)^2, M = pi/6 2^3 density: density = 5243.
  CHECK_NOTHROW(tests::small_column({{"grains.large.density", "5200"}}));
  CHECK_THROWS_WITH(tests::small_column({{"grains.large.density", "5300"}}),
                    Catch::Contains("sinks about"));
}

TEST_CASE("Keys of a container are refused without one") {
  const auto root = files::YamlNode::load_text(R"(scene: 1
dimension: 3
grains: {count: 20, restitution: 0.9, sizes: [0.9, 1.1]}
cell: [5, 5]
base: {drive: {W: 5, amplitude: 1}}
contact: {normal: hertz}
drag: {air: 0.1}
)",
                                               "s.yaml");
  std::string what;
  try {
    simulator::read_scene(root);
  } catch (const files::Error& error) {
    what = error.what();
  }
  for (const char* key : {"`grains.sizes`", "hertz belongs", "`drag`"}) {
    CHECK_THAT(what, Catch::Contains(key));
  }
}
