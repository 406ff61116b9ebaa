#include "simulator/scene/accuracy.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/scene/warnings.hpp"
#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::simulator;

const std::vector<Override> one_percent{{"accuracy", "{T_z: 1 %}"}};

TEST_CASE("The budget is spent: bias bound and 1.96 standard errors make what was asked for") {
  for (const double bound : {0.01, 0.03, 0.1, 0.3}) {
    const auto choice = choose_accuracy(bound, false);
    REQUIRE(choice);
    CHECK(choice->promise() == Approx(bound));
    CHECK(choice->bias_bound < bound);
    REQUIRE(choice->stiffness_factor);
  }
}

TEST_CASE("No pair of settings of the table is cheaper than the one chosen") {
  const auto cost = [](const AccuracySetting& steps, const AccuracySetting& stiffness,
                       double bound) {
    const double left = bound - steps.bias_bound - stiffness.bias_bound;
    return left > 0 ? steps.relative_cost * stiffness.relative_cost / (left * left) : INFINITY;
  };
  for (const double bound : {0.01, 0.02, 0.05, 0.2}) {
    const auto choice = choose_accuracy(bound, false);
    double least = INFINITY;
    double chosen = INFINITY;
    for (const auto& steps : accuracy_table().steps) {
      for (const auto& stiffness : accuracy_table().stiffness) {
        const double one = cost(steps, stiffness, bound);
        least = std::min(least, one);
        if (steps.value == choice->steps_in_contact &&
            stiffness.value == choice->stiffness_factor) {
          chosen = one;
        }
      }
    }
    CHECK(chosen == least);
  }
}

TEST_CASE("Better presets promise more, and every promise is the table's") {
  const auto draft = accuracy_preset("draft", false);
  const auto standard = accuracy_preset("standard", false);
  const auto reference = accuracy_preset("reference", false);
  CHECK(draft.promise() > standard.promise());
  CHECK(standard.promise() > reference.promise());
  double bias = 0;
  for (const auto& row : accuracy_table().steps) bias += row.value == 50 ? row.bias_bound : 0;
  for (const auto& row : accuracy_table().stiffness) bias += row.value == 30 ? row.bias_bound : 0;
  CHECK(standard.bias_bound == Approx(bias));
}

TEST_CASE("A scene that asks for accuracy gets time step, stiffness and rule from the table") {
  const Scene scene = tests::bed_with(one_percent);
  const auto choice = choose_accuracy(0.01, false);
  REQUIRE(scene.accuracy);
  CHECK(scene.accuracy->asked == 0.01);
  CHECK(scene.accuracy->bias_bound == choice->bias_bound);
  CHECK(scene.protocol.time_step_fraction == Approx(1 / choice->steps_in_contact));
  CHECK(*scene.contact.stiffness == Approx(*choice->stiffness_factor * automatic_stiffness(scene)));
  REQUIRE(scene.protocol.until);
  CHECK(scene.protocol.until->quantity == "T_z");
  CHECK(scene.protocol.until->fraction == Approx(choice->standard_error));
}

TEST_CASE("A stiffness that is given is the bed itself and stays") {
  const Scene scene = tests::bed_with({{"accuracy", "{T_z: 1 %}"}, {"contact.stiffness", "2e5"}});
  CHECK(*scene.contact.stiffness == 2e5);
  CHECK(scene.accuracy->bias_bound < tests::bed_with(one_percent).accuracy->bias_bound);
}

TEST_CASE("The canonical text holds the settings chosen, so that the run's key does") {
  const Scene scene = tests::bed_with(one_percent);
  const std::string text = canonical_yaml(scene);
  CHECK(text.find("accuracy") == std::string::npos);
  CHECK(canonical_yaml(tests::scene_of(text)) == text);
}

TEST_CASE("Set from outside, accuracy and what it decides replace each other") {
  CHECK(tests::bed_with({{"accuracy", "draft"}}).accuracy);
  CHECK_FALSE(tests::bed_with({{"accuracy", "draft"}, {"protocol.measure.cycles", "9"}}).accuracy);
  CHECK_FALSE(tests::bed_with({{"accuracy.T_z", "2 %"},
                               {"protocol.time_step.fraction_of_contact_duration", "0.05"}})
                  .accuracy);
}

TEST_CASE("In one file, accuracy and what it decides are refused") {
  const auto beside = [](const std::string& protocol) {
    const auto text = tests::replaced(tests::rough_bed, "protocol: {measure: {cycles: 300}}",
                                      "accuracy: {T_z: 1 %}\nprotocol: " + protocol);
    const auto faults = tests::faults_of(text);
    return std::any_of(faults.begin(), faults.end(), [](const files::Fault& fault) {
      return fault.what.find("is what `accuracy` decides") != std::string::npos;
    });
  };
  CHECK(beside("{measure: {cycles: 300}}"));
  CHECK(beside("{measure: {until: {T_z: 1 %}}}"));
  CHECK(beside("{time_step: {fraction_of_contact_duration: 0.02}}"));
  CHECK(beside("{engine: uniform}"));
  CHECK_FALSE(beside("{measure: {at_most: 300}}"));
  CHECK_FALSE(beside("{transient: {cycles: 30}}"));
}

TEST_CASE("What settings cannot reach is refused, a little more is not") {
  double least = 1;
  for (const auto& steps : accuracy_table().steps) {
    for (const auto& stiffness : accuracy_table().stiffness) {
      least = std::min(least, steps.bias_bound + stiffness.bias_bound);
    }
  }
  CHECK_FALSE(choose_accuracy(least, false));
  CHECK(choose_accuracy(1.01 * least, false));
  CHECK_THROWS_WITH(tests::bed_with({{"accuracy.T_z", std::to_string(100 * least * 0.9) + " %"}}),
                    Catch::Contains("ask for more than that"));
}

TEST_CASE("Beds beyond those measured are warned of at the limit and not inside it") {
  const auto warned = [](const std::string& key, const std::string& value) {
    const Scene scene = tests::bed_with({{"accuracy", "draft"}, {key, value}});
    const auto warnings = scene_warnings(scene, bind_parameters(scene));
    return std::any_of(warnings.begin(), warnings.end(), [](const std::string& text) {
      return text.find("behind `accuracy`") != std::string::npos;
    });
  };
  CHECK_FALSE(warned("base.drive.W", "90"));
  CHECK(warned("base.drive.W", "90.1"));
  CHECK_FALSE(warned("base.drive.W", "5"));
  CHECK(warned("base.drive.W", "4.99"));
  CHECK_FALSE(warned("grains.layers", "2"));
  CHECK(warned("grains.layers", "1"));
  CHECK_FALSE(warned("grains.layers", "8"));
  CHECK(warned("grains.layers", "9"));
  CHECK_FALSE(warned("grains.restitution", "0.7"));
  CHECK(warned("grains.restitution", "0.69"));
  CHECK_FALSE(warned("base.drive.amplitude", "0.3"));
  CHECK(warned("base.drive.amplitude", "0.29"));
}

TEST_CASE("What a run reached is its bias bound and 1.96 of its standard errors") {
  const Scene scene = tests::bed_with({{"accuracy", "{T_z: 5 %}"}});
  Record record;
  record.quantities = {{"T_z", "m g d", {2, 0.02}}};
  const auto reached = reached_accuracy(scene, record);
  REQUIRE(reached);
  CHECK(reached->noise == Approx(0.0196));
  CHECK(reached->reached() == Approx(0.0196 + scene.accuracy->bias_bound));
  CHECK(reached->met());
  record.quantities[0].estimate.standard_error = 0.06;
  CHECK_FALSE(reached_accuracy(scene, record)->met());
  record.at_rest = true;
  CHECK(reached_accuracy(scene, record)->met());
  CHECK_FALSE(reached_accuracy(tests::bed_with({}), record));
}

}  // namespace
