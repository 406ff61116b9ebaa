#include <catch2/catch.hpp>
#include <cmath>

#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using tests::bed_with;
using tests::faults_of;
using tests::rough_bed;

// A = 2 d and omega = 3 sqrt(g/d) said in every way: V_p = 6, W = 36, Gamma = 18, and with
// d = 5 mm and g = 9.81 m/s2 the frequency is 3/(2 pi) sqrt(9.81/0.005) = 21.149051 Hz.
const std::vector<std::pair<std::string, std::string>> ways{{"amplitude", "2"},
                                                            {"amplitude_mm", "10"},
                                                            {"angular_frequency", "3"},
                                                            {"frequency", "0.477464829275686"},
                                                            {"frequency_hz", "21.149051165220158"},
                                                            {"frequency_rpm", "1268.9430699132095"},
                                                            {"W", "36"},
                                                            {"Gamma", "18"}};

std::string told_by(const std::string& name) {
  if (name.starts_with("amplitude")) return "amplitude";
  if (name.find("frequency") != std::string::npos) return "frequency";
  return name;
}

std::string scene_with(const std::string& drive) {
  return tests::replaced(rough_bed, "{W: 22.36, amplitude: 1}", drive) +
         "units: {diameter: 5 mm, gravity: 9.81 m/s2}\n";
}

TEST_CASE("Any two drive keys that determine A and omega do; two that do not are refused") {
  for (const auto& [a, a_value] : ways) {
    for (const auto& [b, b_value] : ways) {
      if (a == b) continue;
      const std::string text =
          scene_with("{" + a + ": " + a_value + ", " + b + ": " + b_value + "}");
      CAPTURE(text);
      if (told_by(a) == told_by(b)) {
        const auto faults = faults_of(text);
        REQUIRE(faults.size() == 1);
        CHECK(faults[0].where == "s.yaml:5:15");
        CHECK_THAT(faults[0].what, Catch::Contains("say the same thing twice"));
      } else {
        const auto drive = tests::scene_of(text).base.drive;
        CHECK(drive.amplitude == Approx(2).epsilon(1e-9));
        CHECK(drive.angular_frequency == Approx(3).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("One, three or no drive keys are refused") {
  for (const char* drive : {"{}", "{W: 3}", "{W: 3, amplitude: 1, Gamma: 3}"}) {
    CAPTURE(drive);
    const auto faults = faults_of(scene_with(drive));
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].what, Catch::Contains("takes exactly two of"));
  }
}

TEST_CASE("A physical drive key without the grain diameter is refused at its place") {
  const auto faults = faults_of(
      tests::replaced(rough_bed, "W: 22.36, amplitude: 1", "frequency_rpm: 300, amplitude_mm: 5"));
  REQUIRE(faults.size() == 2);
  CHECK(faults[0].where == "s.yaml:5:31");
  CHECK(faults[1].where == "s.yaml:5:50");
  CHECK_THAT(faults[0].what, Catch::Contains("units: {diameter: 5 mm}"));
}

TEST_CASE("Drives beyond all sense are refused before they overflow") {
  for (const char* drive : {"{W: 1e300, amplitude: 1e-5}", "{W: 1e-300, amplitude: 1}",
                            "{Gamma: 1e308, frequency: 1e-300}", "{W: 1, Gamma: 1e-200}"}) {
    CAPTURE(drive);
    const auto faults = faults_of(scene_with(drive));
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].what, Catch::Contains("expected A in"));
  }
}

}  // namespace
