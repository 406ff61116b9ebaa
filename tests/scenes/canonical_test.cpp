#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "files/csv.hpp"
#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::simulator;
using files::number_text;

/// Scenes with every member drawn, at random digits, from what is allowed.
class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  std::vector<Override> next() {
    const bool flat = chance();
    std::vector<Override> keys{
        {"dimension", flat ? "2" : "3"},
        {"cell", flat ? "[" + between(2.2, 50) + "]"
                      : "[" + between(2.2, 50) + ", " + between(2.2, 50) + "]"},
        {"grains.count", std::to_string(1 + random_() % 1000)},
        {"grains.restitution", between(0.01, 1)},
        {"base.restitution", between(0.01, 1)},
        {"grains.friction", chance() ? "0" : between(0, 2)},
        {"base.friction", chance() ? "0" : between(0, 2)},
        {"base.drive.amplitude", between(0.01, 5)},
        {chance() ? "base.drive.W" : "base.drive.frequency", between(0.1, 100)},
        {"contact.stiffness", chance() ? "auto" : between(1e3, 1e9)},
        {"contact.allow_soft", "true"},
        {"contact.tangential", "{law: viscous_coulomb, damping: " + damping() + "}"},
        {"protocol.settle", chance() ? "auto" : between(0, 100)},
        {"protocol.engine", pick({"auto", "uniform", "events"})},
        {"protocol.contacts", pick({"auto", "fine", "closed"})},
        {"protocol.time_step.fraction_of_contact_duration", between(0.001, 0.5)},
        {"protocol.time_step.allow_coarse", "true"},
        {"seed", std::to_string(random_() >> 1)},
    };
    if (chance()) {
      keys.push_back({"lid.height", between(1100, 2000)});
      keys.push_back({"lid.moves", pick({"with_base", "fixed"})});
      keys.push_back({"lid.friction", chance() ? "0" : between(0, 2)});
      keys.push_back({"gravity", pick({"0", "1"})});
    }
    if (chance()) {
      keys.push_back({"side_walls.across", "x"});
      keys.push_back({"side_walls.restitution", between(0.01, 1)});
      keys.push_back({"base.moves_along", pick({"x", "z"})});
    }
    const bool walled = keys.size() > 18;
    if (walled) keys.push_back({"protocol.engine", pick({"auto", "uniform"})});
    if (chance()) {
      keys.push_back({"protocol.snapshots.phases", "[" + between(0.5, 1) + ", 0]"});
      if (chance())
        keys.push_back({"protocol.snapshots.cycles", std::to_string(1 + random_() % 9)});
    }
    if (chance()) keys.push_back({"protocol.transient.cycles", std::to_string(random_() % 1000)});
    if (chance()) {
      keys.push_back(
          {"protocol.measure.until." + pick({"T_z", "T_x", "T"}), between(0, 50) + " %"});
    }
    return keys;
  }

 private:
  bool chance() { return random_() % 2 == 0; }
  std::string pick(const std::vector<std::string>& words) {
    return words[random_() % words.size()];
  }
  std::string between(double low, double high) {
    return number_text(std::uniform_real_distribution<>(low, high)(random_));
  }
  std::string damping() { return chance() ? pick({"c_n", "critical"}) : between(0, 100); }

  std::mt19937_64 random_;
};

TEST_CASE("The canonical text of any scene reads back as that scene") {
  RandomScenes scenes(20261122);
  for (int round = 0; round < 500; ++round) {
    const Scene scene = tests::bed_with(scenes.next());
    const std::string text = canonical_yaml(scene);
    CAPTURE(text);
    const Scene back = tests::scene_of(text);
    REQUIRE(canonical_yaml(back) == text);
    // Not only the text: what a bed is made of must be the same double.
    REQUIRE(back.base.drive.amplitude == scene.base.drive.amplitude);
    REQUIRE(back.base.drive.angular_frequency == scene.base.drive.angular_frequency);
    REQUIRE(back.cell == scene.cell);
    REQUIRE(back.grains.layers == scene.grains.layers);
    REQUIRE(back.grains.restitution == scene.grains.restitution);
    REQUIRE(back.contact.stiffness == scene.contact.stiffness);
    REQUIRE(back.contact.tangential == scene.contact.tangential);
    REQUIRE(back.contact.damping_value == scene.contact.damping_value);
    REQUIRE(back.protocol.time_step_fraction == scene.protocol.time_step_fraction);
    REQUIRE(back.gravity == scene.gravity);
    REQUIRE(back.lid.has_value() == scene.lid.has_value());
    if (scene.lid) {
      REQUIRE(back.lid->height == scene.lid->height);
      REQUIRE(back.lid->moves_with_base == scene.lid->moves_with_base);
      REQUIRE(back.lid->restitution == scene.lid->restitution);
      REQUIRE(back.lid->friction == scene.lid->friction);
    }
    REQUIRE(back.side_walls.has_value() == scene.side_walls.has_value());
    REQUIRE(back.base.direction == scene.base.direction);
    REQUIRE(back.protocol.snapshots.phases == scene.protocol.snapshots.phases);
    REQUIRE(back.protocol.until.has_value() == scene.protocol.until.has_value());
    if (scene.protocol.until) {
      REQUIRE(back.protocol.until->fraction == scene.protocol.until->fraction);
    }
    REQUIRE(back.protocol.engine == scene.protocol.engine);
    REQUIRE(back.protocol.contacts == scene.protocol.contacts);
    REQUIRE(back.seed == scene.seed);
  }
}

TEST_CASE("Neither the order of keys nor comments nor spelling changes the canonical text") {
  const std::string expected = canonical_yaml(tests::scene_of(tests::rough_bed));
  std::vector<std::string> lines{"scene: 1",
                                 "dimension: 3",
                                 "grains: {layers: 4, restitution: 0.9}",
                                 "cell: [5, 5]",
                                 "base: {drive: {W: 22.36, amplitude: 1}}",
                                 "protocol: {measure: {cycles: 300}}"};
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    std::shuffle(lines.begin(), lines.end(), random);
    std::string text;
    for (const auto& line : lines) text += "# a comment\n" + line + "   # another\n\n";
    REQUIRE(canonical_yaml(tests::scene_of(text)) == expected);
  }
  CHECK(canonical_yaml(tests::scene_of(
            "protocol:\n  measure:\n    cycles: 3e2\n  settle: auto\n  transient: auto\n"
            "base:\n  drive:\n    amplitude: 1.0\n    W: 2.236e1\n  friction: -0.0\n"
            "contact: {normal: linear_spring_dashpot, stiffness: auto, tangential: frictionless}\n"
            "grains: {restitution: .9, count: 100, friction: 0}\nseed: 1\ngravity: 1.0\n"
            "dimension: 3\ncell:\n- 5.0\n- 5\nscene: 1\n")) == expected);
}

TEST_CASE("Every member of a scene shows in its canonical text") {
  const std::string standard = canonical_yaml(tests::bed_with({{"base.friction", "0.1"}}));
  const std::vector<Override> changes{
      {"dimension", "2"},
      {"cell", "[5, 6]"},
      {"grains.count", "99"},
      {"grains.restitution", "0.9000000000000001"},
      {"grains.friction", "1e-300"},
      {"base.restitution", "0.91"},
      {"base.friction", "0.2"},
      {"base.drive.W", "22.36000000000001"},
      {"base.drive.amplitude", "1.1"},
      {"contact.stiffness", "2e5"},
      {"contact.tangential", "{law: viscous_coulomb, damping: critical}"},
      {"protocol.settle", "10"},
      {"protocol.transient.cycles", "10"},
      {"protocol.measure.cycles", "301"},
      {"protocol.measure.until.T", "1 %"},
      {"protocol.time_step.fraction_of_contact_duration", "0.01"},
      {"protocol.engine", "uniform"},
      {"protocol.contacts", "fine"},
      {"seed", "2"},
  };
  for (const auto& change : changes) {
    CAPTURE(change.path);
    std::vector<Override> overrides{{"base.friction", "0.1"}, change};
    if (change.path == "dimension") overrides.push_back({"cell", "[25]"});
    CHECK(canonical_yaml(tests::bed_with(overrides)) != standard);
  }
}

}  // namespace
