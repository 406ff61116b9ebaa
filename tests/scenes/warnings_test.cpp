#include "simulator/scene/warnings.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "files/csv.hpp"
#include "simulator/scene/step_bias.hpp"
#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using namespace shakebed::simulator;

bool warned(const std::vector<Override>& overrides, const std::string& fragment) {
  const Scene scene = tests::bed_with(overrides);
  const auto warnings = scene_warnings(scene, bind_parameters(scene));
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
    return warning.find(fragment) != std::string::npos;
  });
}

TEST_CASE("The standard bed is nothing to warn of") {
  const Scene scene = tests::bed_with({});
  CHECK(scene_warnings(scene, bind_parameters(scene)).empty());
}

TEST_CASE("Each doubtful bed is warned of, its neighbour is not") {
  const std::string fraction = "protocol.time_step.fraction_of_contact_duration";
  CHECK(warned({{fraction, "0.11"}}, "dt above t_c/10"));
  CHECK_FALSE(warned({{fraction, "0.1"}}, "dt above t_c/10"));
  CHECK(warned({{"contact.stiffness", "2e3"}}, "overlaps"));
  CHECK_FALSE(warned({{"contact.stiffness", "2e5"}}, "overlaps"));
  CHECK(warned({{"contact.stiffness", "1e4"}}, "softness"));
  // Twelve layers on the k_n that `auto` gives four (2e4 m V_p^2/d^2 at W = 22.36).
  CHECK(warned({{"grains.layers", "12"}, {"contact.stiffness", "447200"}}, "bed of 12 layers"));
  CHECK_FALSE(warned({{"grains.layers", "20"}, {"contact.stiffness", "2.3e6"}}, "layers"));
  CHECK_FALSE(warned({{"grains.layers", "4"}, {"contact.stiffness", "447200"}}, "layers"));
  CHECK(warned({{"base.drive.W", "0.99"}}, "stays at rest"));
  CHECK_FALSE(warned({{"base.drive.W", "1.01"}}, "stays at rest"));
  CHECK(warned({{"grains.restitution", "1"}}, "heats up"));
  CHECK_FALSE(warned({{"grains.restitution", "1"}, {"base.friction", "0.1"}}, "heats up"));
  CHECK(warned({{"contact.stiffness", "300"}, {"contact.allow_soft", "true"}}, "T_z may be off"));
  const std::string until = "protocol.measure.until.T_z";
  const std::string at_most = "protocol.measure.at_most";
  // 30 flights of W/pi = 7.12 cycles.
  CHECK(warned({{until, "1 %"}, {at_most, "213"}}, "at_most = 213 cycles are few"));
  CHECK_FALSE(warned({{until, "1 %"}, {at_most, "214"}}, "cycles are few"));
  CHECK(warned({{"grains.count", "1"}}, "one grain"));
  CHECK(warned({{"protocol.measure.cycles", "200"}}, "measured cycles are few"));
}

TEST_CASE("Warnings begin at their limits") {
  const std::string W = "base.drive.W";
  const std::string k_n = "contact.stiffness";
  // V_p = 3, N = 4: 6/sqrt(k_n) + 4/k_n = 0.05 at k_n = 14559.
  CHECK(warned({{W, "9"}, {k_n, "14500"}}, "overlaps"));
  CHECK_FALSE(warned({{W, "9"}, {k_n, "14620"}}, "overlaps"));
  // W = 22.36: omega pi/sqrt(k_n) (1 + (ln e/pi)^2)^(1/2) = 0.1 at k_n = 22093.
  CHECK(warned({{k_n, "22000"}}, "softness"));
  CHECK_FALSE(warned({{k_n, "22200"}}, "softness"));
  CHECK(warned({{"protocol.measure.cycles", "213"}}, "measured cycles are few"));
  CHECK_FALSE(warned({{"protocol.measure.cycles", "214"}}, "measured cycles are few"));
  CHECK_FALSE(warned({{"grains.count", "2"}}, "one grain"));
}

TEST_CASE("A coarse step is said to cost what the most similar measured bed lost by it") {
  const auto law_of = [](const std::vector<Override>& overrides) {
    const Scene scene = tests::bed_with(overrides);
    return nearest_step_law(scene, bind_parameters(scene));
  };
  for (const auto& law : step_laws()) {
    const std::vector<Override> like_it{{"dimension", std::to_string(law.dimension)},
                                        {"cell", law.dimension == 2 ? "[20]" : "[5, 4]"},
                                        {"grains.layers", files::number_text(law.layers)},
                                        {"grains.friction", law.rough ? "0.4" : "0"},
                                        {"base.friction", law.rough ? "0.4" : "0"},
                                        {"grains.restitution", files::number_text(law.restitution)},
                                        {"base.restitution", files::number_text(law.restitution)},
                                        {"base.drive.W", files::number_text(law.W)},
                                        {"protocol.contacts", law.closed ? "closed" : "fine"}};
    const StepLaw found = law_of(like_it);
    CHECK(found.scene == law.scene);
    CHECK(found.coefficient == law.coefficient);
  }
  const auto stepped = law_of({{"protocol.engine", "uniform"}});
  CHECK_FALSE(stepped.closed);
  CHECK(law_of({}).closed);
  const double coarse = 100 * stepped.coefficient * 0.15 * 0.15;
  CHECK(warned(
      {{"protocol.engine", "uniform"}, {"protocol.time_step.fraction_of_contact_duration", "0.15"}},
      "off by about " + files::rounded_text(coarse, 2) + " %"));
}

TEST_CASE("Largest overlap and drive angle follow their formulas") {
  // V_p = 3 and k_n = 9e4: 2 V_p sqrt(m/k_n) = 0.02; N/k_n = 4/9e4.
  const Scene scene = tests::bed_with({{"base.drive.W", "9"}, {"contact.stiffness", "9e4"}});
  const Parameters parameters = bind_parameters(scene);
  CHECK(expected_largest_overlap(scene, parameters) == Approx(0.02 + 4 / 9e4));
  // An undamped contact at the base lasts pi sqrt(m/k_n); e = 0.9 makes it 0.06 % longer.
  CHECK(drive_angle_in_contact(scene, parameters) == Approx(3 * M_PI / 300).epsilon(1e-3));
}

TEST_CASE("Contacts that overlap by half a diameter are refused, softer by permission only") {
  // V_p = 3, N = 4: 6/sqrt(k_n) + 4/k_n = 0.5 at k_n = 159.6.
  const auto refused = [](const char* k_n) {
    return !tests::faults_of(tests::rough_bed, {{"base.drive.W", "9"}, {"contact.stiffness", k_n}})
                .empty();
  };
  CHECK(refused("159"));
  CHECK_FALSE(refused("161"));
  const Scene soft = tests::bed_with(
      {{"base.drive.W", "9"}, {"contact.stiffness", "159"}, {"contact.allow_soft", "true"}});
  CHECK(soft.contact.allow_soft);
  CHECK_FALSE(tests::bed_with({{"contact.allow_soft", "true"}}).contact.allow_soft);
}

// `auto` takes 2e4 N/4 m V_p^2/d^2, so that twenty layers on the k_n of four have a fifth of it.
TEST_CASE("Twenty layers on the stiffness of four are refused, softer by permission only") {
  const auto faults = [](const char* layers, const char* k_n) {
    return tests::faults_of(
        tests::rough_bed,
        {{"base.drive.W", "9"}, {"grains.layers", layers}, {"contact.stiffness", k_n}});
  };
  const auto refused = faults("20", "180000");
  REQUIRE(refused.size() == 1);
  CHECK_THAT(refused.front().what, Catch::Contains("180000 is too soft for 20 layers") &&
                                       Catch::Contains("at least 225000") &&
                                       Catch::Contains("`auto` would take 9e+05"));
  CHECK(faults("20", "225000").empty());
  CHECK(faults("16", "180000").empty());
  CHECK(faults("4", "2000").empty());
  CHECK(tests::bed_with({{"base.drive.W", "9"},
                         {"grains.layers", "20"},
                         {"contact.stiffness", "180000"},
                         {"contact.allow_soft", "true"}})
            .contact.allow_soft);
}

}  // namespace
