#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/figures/scratch.hpp"
#include "tests/scenes/texts.hpp"

namespace {

using namespace shakebed;
using tests::faults_of;
using tests::replaced;
using tests::rough_bed;

struct Case {
  std::string from, to;     ///< a change to the standard bed
  std::string where, what;  ///< the only fault it makes
};

const std::string grains = "{layers: 4, restitution: 0.9}";
const std::string measure = "{measure: {cycles: 300}}";
const std::string last = "protocol";  // new lines go before it

const std::vector<Case> single_faults{
    {"scene: 1", "scene: 2", "s.yaml:1:8", "reads scenes of schema 1, got schema 2"},
    {"scene: 1\n", "", "s.yaml:1:1", "`scene` is missing"},
    {"scene: 1", "scene: one", "s.yaml:1:8", "expected a whole number, got `one`"},
    {"dimension: 3", "dimension: 4", "s.yaml:2:12", "in [2, 3], got `4`"},
    {"dimension: 3", "dimension: 3.5", "s.yaml:2:12", "expected a whole number"},
    {"dimension: 3", "dimension: 03", "s.yaml:2:12", "octal"},
    {"dimension: 3", "dimension: \"3\"", "s.yaml:2:12", "quoted text"},
    {"dimension: 3\n", "", "s.yaml:1:1", "`dimension` is missing"},
    {"dimension: 3", "dimension: 2", "s.yaml:4:7", "expected 1 width in dimension 2, got 2"},
    {last, "gravity: 0\nprotocol", "s.yaml:6:10", "needs a lid"},
    {last, "lid: {height: 4}\nprotocol", "s.yaml:6:15", "100 grains in this cell need 7.66 d"},
    {last, "lid: {height: 8, moves: fixed}\nprotocol", "s.yaml:6:15", "base is highest below"},
    {last, "lid: {moves: fixed}\nprotocol", "s.yaml:6:6", "needs `height`"},
    {last, "lid: {height: 10, moves: up}\nprotocol", "s.yaml:6:26", "with_base or fixed"},
    {last, "lid: {height: 10, restitution: 0}\nprotocol", "s.yaml:6:32", "(0, 1]"},
    {last, "lid: {hight: 10}\nprotocol", "s.yaml:6:7", "did you mean `height`"},
    {last, "side_walls: {friction: 0.1}\nprotocol", "s.yaml:6:13", "needs `across`"},
    {last, "side_walls: {across: y}\nprotocol", "s.yaml:6:22", "expected x"},
    {"[5, 5]", "[0.8, 5]\nside_walls: {across: x}", "s.yaml:4:8", "expected a value in [2.2"},
    {"{drive: {W", "{moves_along: x, drive: {W", "s.yaml:5:21", "needs walls that push"},
    {"protocol: {", "lid: {height: 10}\nprotocol: {engine: events, ", "s.yaml:7:20",
     "does not know a lid"},
    {"protocol: {", "protocol: {snapshots: {cycles: 2}, ", "s.yaml:6:23", "needs `phases`"},
    {"protocol: {", "protocol: {snapshots: {phases: [1]}, ", "s.yaml:6:33", "[0, 1)"},
    {"protocol: {", "protocol: {snapshots: {phases: [0, 0]}, ", "s.yaml:6:32",
     "stands there twice"},
    {"protocol: {", "protocol: {snapshots: {phases: [0], cycles: 301}, ", "s.yaml:6:45",
     "allows 300"},
    {"grains: {",
     "lid: {height: 20, friction: 0.2}\ncontact: {tangential: frictionless}\ngrains: {",
     "s.yaml:3:29", "`lid.friction` is not 0"},
    {last, "gravity: 0.5\nprotocol", "s.yaml:6:10", "unit of acceleration"},

    {"restitution: 0.9", "restitution: 0", "s.yaml:3:34", "in (0, 1], got `0`"},
    {"restitution: 0.9", "restitution: 1.01", "s.yaml:3:34", "in (0, 1], got `1.01`"},
    {"restitution: 0.9", "restitution: nan", "s.yaml:3:34", "expected a finite number"},
    {"restitution: 0.9", "restitution: [0.9]", "s.yaml:3:34", "expected a number, got a list"},
    {"restitution: 0.9", "restitution: ", "s.yaml:3:21", "expected a number, got nothing"},
    {"restitution: 0.9", "colour: 1, restitution: 0.9", "s.yaml:3:21", "unknown key"},
    {", restitution: 0.9", "", "s.yaml:3:9", "`grains.restitution` is missing"},
    {"restitution: 0.9", "restituton: 0.9", "s.yaml:3:21",
     "unknown key `grains.restituton`; did you mean `restitution`?"},
    {"0.9}", "0.9, friction: -0.1}", "s.yaml:3:49", "in [0, 100], got `-0.1`"},
    {"layers: 4", "layesr: 4", "s.yaml:3:10", "did you mean `layers`?"},
    {"amplitude: 1", "amplitud: 1", "s.yaml:5:26", "did you mean `amplitude`?"},
    {"cell:", "Cell:", "s.yaml:4:1", "did you mean `cell`?"},
    {"0.9}", "0.9, restitution: 0.8}", "s.yaml:3:39", "already given"},
    {"0.9}", "0.9, count: 100}", "s.yaml:3:9", "both given; keep one"},
    {"layers: 4, ", "", "s.yaml:3:9", "needs `layers` or `count`"},
    {"layers: 4", "layers: 3.99", "s.yaml:3:18",
     "come to 99.75 grains; write count: 100, which is 4 layers"},
    {"layers: 4", "layers: 1e-4", "s.yaml:3:18", "write count: 1, which is 0.04 layers"},
    {"layers: 4", "count: 1.5", "s.yaml:3:17", "expected a whole number"},
    {"layers: 4", "count: 0", "s.yaml:3:17", "in [1, 1e+06]"},
    {grains, "100", "s.yaml:3:9", "expected a map with keys of: count, layers"},

    {"[5, 5]", "[5]", "s.yaml:4:7", "expected 2 widths in dimension 3, got 1"},
    {"[5, 5]", "[5, 2]", "s.yaml:4:11", "in [2.2, 10000] d, got `2`"},
    {"[5, 5]", "5", "s.yaml:4:7", "expected a list such as [5, 5], got `5`"},
    {"[5, 5]", "[5, wide]", "s.yaml:4:11", "expected a finite number, got `wide`"},
    {"cell: [5, 5]\n", "", "s.yaml:1:1", "`cell` is missing"},
    {"cell:", "cell_mm:", "s.yaml:4:10", "`cell_mm` has a physical unit"},

    {"W: 22.36", "W: 0", "s.yaml:5:19", "expected a value > 0, got `0`"},
    {"W: 22.36", "W: -1", "s.yaml:5:19", "expected a value > 0, got `-1`"},
    {"W: 22.36", "V_p: 3, W: 22.36", "s.yaml:5:16", "unknown key `base.drive.V_p`"},
    {"amplitude: 1}", "amplitude: 1}, W: 3", "s.yaml:5:41", "did you mean `base.drive.W`?"},

    {last, "contact: {stiffness: soft}\nprotocol", "s.yaml:6:22", "number or auto, got `soft`"},
    {last, "contact: {stiffness: aut}\nprotocol", "s.yaml:6:22", "did you mean `auto`?"},
    {last, "contact: {normal: hertz}\nprotocol", "s.yaml:6:19", "belongs to beds in a container"},
    {last, "contact: {tangential: {law: cundall}}\nprotocol", "s.yaml:6:29",
     "expected viscous_coulomb or cundall_strack or frictionless"},
    {last, "contact: {tangential: {damping: c_n}}\nprotocol", "s.yaml:6:23", "needs `law`"},
    {last, "contact: {tangential: {law: frictionless, damping: 3}}\nprotocol", "s.yaml:6:52",
     "means nothing to the law frictionless"},
    {last, "contact: {tangential: {law: viscous_coulomb, damping: -3}}\nprotocol", "s.yaml:6:55",
     "expected a value >= 0"},
    {grains + "\n",
     "{layers: 4, restitution: 0.9, friction: 0.4}\ncontact: {tangential: "
     "frictionless}\n",
     "s.yaml:3:49", "`grains.friction` is not 0, but `contact.tangential` is frictionless"},

    {measure, "{measure: {cycles: 0}}", "s.yaml:6:30", "in [1, 1e+09]"},
    {measure, "{measure: {until: {T_z: 1}}}", "s.yaml:6:35", "a percentage such as `1 %`"},
    {measure, "{measure: {until: {T_z: 0 %}}}", "s.yaml:6:35", "in (0, 50] %, got `0 %`"},
    {measure, "{measure: {until: {T_q: 1 %}}}", "s.yaml:6:30", "did you mean `T_z`?"},
    {measure, "{measure: {until: {T_z: 1 %, T: 1 %}}}", "s.yaml:6:29", "exactly one quantity"},
    {measure, "{measure: {until: 5}}", "s.yaml:6:29", "expected a map with keys of: T_z, T_x"},
    {measure, "{measure: 5}", "s.yaml:6:21", "expected a map with keys of: cycles, until"},
    {measure, "5", "s.yaml:6:11", "expected a map with keys of: prepare, settle, transient"},
    {"{drive: {W: 22.36, amplitude: 1}}", "{drive: 3}", "s.yaml:5:15", "expected a map"},
    {"{drive: {W: 22.36, amplitude: 1}}", "3", "s.yaml:5:7", "expected a map"},
    {last, "contact: 3\nprotocol", "s.yaml:6:10", "expected a map"},
    {last, "contact: {tangential: 3}\nprotocol", "s.yaml:6:23", "expected frictionless or a map"},
    {measure, "{measure: {until: {}}}", "s.yaml:6:29", "exactly one quantity"},
    {measure, "{measure: {cycles: 3, at_most: 5}}", "s.yaml:6:42", "exclude each other"},
    {measure, "{measure: {cycles: 3, until: {T: 1 %}}}", "s.yaml:6:40", "exclude each other"},
    {measure, "{transient: {}}", "s.yaml:6:23", "takes auto or {cycles: n}"},
    {measure, "{transient: 5}", "s.yaml:6:23", "expected auto or a map, got `5`"},
    {measure, "{settle: -1}", "s.yaml:6:20", "expected a value >= 0"},
    {measure, "{engine: magic}", "s.yaml:6:20", "auto or uniform or events, got `magic`"},
    {measure, "{time_step: {fraction_of_contact_duration: 0.21}}", "s.yaml:6:54",
     "or allow_coarse: true"},
    {measure, "{time_step: {fraction_of_contact_duration: 0.6, allow_coarse: true}}", "s.yaml:6:54",
     "in [1e-04, 0.5] t_c"},
    {measure, "{time_step: {allow_coarse: yes}}", "s.yaml:6:38", "expected true or false"},

    {last, "seed: -1\nprotocol", "s.yaml:6:7", "expected a value >= 0"},
    {last, "seed: 1.5\nprotocol", "s.yaml:6:7", "expected a whole number"},
    {last, "units: {diameter: 5}\nprotocol", "s.yaml:6:19", "one of the units mm, m, cm, um"},
    {last, "units: {diameter: 5 ft}\nprotocol", "s.yaml:6:19", "one of the units mm, m, cm, um"},
    {last, "units: {diameter: 0 mm}\nprotocol", "s.yaml:6:19", "expected a value > 0 mm"},
    {last, "units: {colour: red}\nprotocol", "s.yaml:6:9", "known here: diameter density gravity"},
    {last, "housing: {cylinder: 3}\nprotocol", "s.yaml:6:1", "unknown key `housing`"},
};

TEST_CASE("The standard bed has no fault") { CHECK(faults_of(rough_bed).empty()); }

TEST_CASE("Each fault is found alone, at its file:line:column, in words that help") {
  for (const auto& one : single_faults) {
    const std::string text = replaced(rough_bed, one.from, one.to);
    CAPTURE(text);
    std::vector<files::Fault> faults;
    try {
      std::vector<files::Fault> structure;
      const tests::ScratchFolder scratch;
      simulator::read_scene(scratch.file("s.yaml", text));
    } catch (const files::Error& error) {
      faults = error.faults();
      CHECK(error.kind() == files::Error::Kind::bad_input);
    }
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].where.ends_with("/" + one.where));
    CHECK_THAT(faults[0].what, Catch::Contains(one.what));
  }
}

TEST_CASE("All faults of a file are reported in one pass") {
  const tests::ScratchFolder scratch;
  const auto file = scratch.file("s.yaml",
                                 "scene: 1\n"
                                 "dimension: 5\n"
                                 "grains: {layers: 4, restitution: 0, friktion: 0.4}\n"
                                 "cell: [1, x]\n"
                                 "cell: [5, 5]\n"
                                 "base: {drive: {W: -3}}\n"
                                 "protocol: {measure: {cycles: 010, at_most: 3}}\n");
  std::vector<std::string> places;
  try {
    simulator::read_scene(file);
  } catch (const files::Error& error) {
    for (const auto& fault : error.faults()) {
      REQUIRE(fault.where.starts_with(file.string() + ":"));
      places.push_back(fault.where.substr(file.string().size() + 1));
    }
  }
  std::sort(places.begin(), places.end());
  CHECK(places == std::vector<std::string>{"2:12", "3:34", "3:37", "4:11", "4:8", "5:1", "6:15",
                                           "6:19", "7:30", "7:44"});
}

TEST_CASE("What is not a scene at all is refused in one sentence") {
  for (const char* text : {"", "5", "[1, 2]", "just words"}) {
    CAPTURE(text);
    const auto faults = faults_of(text);
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0].what, Catch::Contains("expected a scene, a map that starts with"));
  }
}

}  // namespace
