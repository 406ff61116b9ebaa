#include <catch2/catch.hpp>
#include <string>

#include "tests/scenes/program.hpp"

// Scenes of a bed in a container that cannot be meant, one by one, through the program: what is
// wrong, and what to write.
namespace {

using shakebed::tests::Outcome;
using shakebed::tests::shakebed_says;

const std::string bed = "'" SHAKEBED_SOURCE_FOLDER "/scenes/brazil_nut.yaml'";
const std::string tiny =
    bed +
    " --set grains.count=5 --set protocol.measure.cycles=1 --set container.cylinder.diameter=5"
    " --set grains.large.diameter=2 --set base.drive.frequency=1 --set base.drive.amplitude=0.1";

TEST_CASE("A container that cannot be filled as asked is refused, with what would fit") {
  struct Case {
    std::string set, what;
  };
  for (const auto& [set, what] : {
           Case{"grains.large.diameter=12",
                "a large grain of 12 d leaves no room for a small one "
                "beside it in a cylinder of 12.25 d; it may have at "
                "most 11.25 d"},
           Case{"container.cylinder.diameter=1.9", "expected a value in [2, 1000] d, got `1.9`"},
           Case{"grains.sizes=[1,1.1] --set container.cylinder.diameter=2.1",
                "a cylinder of 2.1 d is narrower than two grains"},
           Case{"grains.count=2000000", "expected a value in [1, 1e+06]"},
           Case{"lid.height=30", "`lid` means nothing to a bed in a container"},
           Case{"side_walls.across=x", "`side_walls` means nothing"},
           Case{"gravity=0", "a bed in a container, which is open above, needs 1"},
       }) {
    CAPTURE(set);
    for (const char* command : {"check ", "run ", "export "}) {
      const Outcome outcome = shakebed_says(command + bed + " --set " + set);
      CHECK(outcome.code == 2);
      CHECK_THAT(outcome.output, Catch::Contains(what));
    }
  }
  // One fault, not what follows from it as well.
  CHECK_THAT(shakebed_says("check " + bed +
                           " --set grains.sizes=[1,1.1] --set container.cylinder.diameter=2.1")
                 .output,
             !Catch::Contains("leaves no room"));
}

// An open cylinder holds any number of grains; a cell under a lid does not.
TEST_CASE("More grains than fit under a lid are refused with the height they need") {
  const Outcome outcome =
      shakebed_says("check '" SHAKEBED_SOURCE_FOLDER "/scenes/rough_3d.yaml' --set lid.height=3");
  CHECK(outcome.code == 2);
  CHECK_THAT(outcome.output, Catch::Contains("100 grains in this cell need 7.66 d between base "
                                             "and lid, which leave 3 d"));
}

// t_c = pi sqrt(m_eff/k_n): ten times k_n is sqrt(10) times finer. Where all contacts are
// over-damped it is 1/gamma_n that counts: pi/2000/25 = 6.28e-5.
TEST_CASE("Contacts stiffer than the step resolves are refused with the step to write") {
  struct Case {
    std::string set, what;
  };
  for (const auto& [set, what] :
       {Case{"contact.stiffness=2e6", "t_c/7.85 of the shortest contact; write at most 6.28e-05"},
        Case{"container.wall.stiffness=2e6", "write at most 8.89e-05"},
        Case{"contact.gamma_n=2000", "write at most 6.28e-05"},
        Case{"grains.sizes=[0.5,1]", "write at most"}}) {
    CAPTURE(set);
    const Outcome outcome = shakebed_says("check " + bed + " --set " + set);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.output, Catch::Contains(what));
  }
  for (const char* set : {"contact.stiffness=2e6 --set protocol.time_step.value=6.28e-5",
                          "contact.gamma_n=2000 --set protocol.time_step.value=6.28e-5",
                          "contact.stiffness=2e6 --set protocol.time_step.allow_coarse=true"}) {
    CAPTURE(set);
    CHECK(shakebed_says("check " + bed + " --set " + set).code == 0);
  }
}

TEST_CASE("A share of t_c too large for a container is refused as well") {
  const std::string step = " --set protocol.time_step='{fraction_of_contact_duration: ";
  CHECK_THAT(shakebed_says("check " + bed + step + "0.06}'").output,
             Catch::Contains("fewer than 20 steps; write at most 0.05"));
  CHECK(shakebed_says("check " + bed + step + "0.06, allow_coarse: true}'").code == 0);
  CHECK(shakebed_says("check " + bed + step + "0.05}'").code == 0);
}

TEST_CASE("Kinds of contact that are over-damped, or nearly, are reported by check and by run") {
  const std::string nearly = "large-wall contacts are close to over-damped: e = 0.059";
  CHECK_THAT(shakebed_says("check " + bed).output, Catch::Contains(nearly));
  const std::string over = "large-wall contacts are over-damped: grains stick together";
  CHECK_THAT(shakebed_says("check " + bed + " --set contact.gamma_n=60").output,
             Catch::Contains(over));
  const Outcome run = shakebed_says("run " + tiny + " --set contact.gamma_n=120");
  CHECK(run.code == 0);
  CHECK_THAT(run.output, Catch::Contains(over));
}

}  // namespace
