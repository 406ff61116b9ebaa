#include <catch2/catch.hpp>
#include <string>

#include "tests/scenes/program.hpp"

// The program as a user calls it: exit codes, and that faults are told on standard error.
namespace {

using shakebed::tests::Outcome;

Outcome shakebed(const std::string& arguments) { return shakebed::tests::shakebed_says(arguments); }

const std::string rough = "'" SHAKEBED_SOURCE_FOLDER "/scenes/rough_3d.yaml'";
const std::string smooth = "'" SHAKEBED_SOURCE_FOLDER "/scenes/smooth_2d.yaml'";

TEST_CASE("Help and version are fine, in every subcommand") {
  for (const char* command :
       {"", "run ", "check ", "sweep ", "sweep run ", "sweep status ", "sweep collect ", "trade ",
        "extremes ", "fit ", "figure ", "network ", "export "}) {
    CAPTURE(command);
    const Outcome help = shakebed(std::string(command) + "--help");
    CHECK(help.code == 0);
    CHECK_THAT(help.output, Catch::Contains("Usage: "));
  }
  CHECK(shakebed("--version").code == 0);
  CHECK_THAT(shakebed("--version").output, Catch::StartsWith("shakebed "));
  for (const char* command : {"run", "check", "export"}) {
    CHECK_THAT(shakebed(std::string(command) + " --help").output,
               Catch::Contains("equivalent drive keys replaces the other"));
  }
}

TEST_CASE("Usage faults exit with 2 and say what is wrong") {
  struct Case {
    std::string arguments, what;
  };
  const Case cases[] = {
      {"", "subcommand is required"},
      {"rnu scene.yaml", "unknown subcommand `rnu`; did you mean `run`?"},
      {"run", "SCENE is required"},
      {"run --output", "--output"},
      {"run a.yaml --colour red", "--colour"},
      {"check", "SCENE (or one of --keys, --schema, --accuracy) is required"},
      {"check " + rough + " --set W", "expected key=value"},
      {"check --keys --schema", "excludes"},
      {"sweep", "subcommand is required"},
      {"sweep run", "SWEEP is required"},
      {"sweep run s.yaml --jobs many", "--jobs"},
      {"sweep run s.yaml --jobs -1", "--jobs"},
      {"fit", "FIT is required"},
      {"figure", "ID is required"},
      {"network", "SNAPSHOT (or --grains with --contacts) is required"},
      {"network --grains g.csv", "--grains requires --contacts"},
      {"network --grains g.csv --contacts c.csv --passes 0", "--passes"},
      {"export " + rough + " --format gromacs", "--format"},
  };
  for (const auto& one : cases) {
    CAPTURE(one.arguments);
    const Outcome outcome = shakebed(one.arguments);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.output, Catch::Contains("shakebed: error: ") && Catch::Contains(one.what));
  }
}

TEST_CASE("check says what a bed models and what it leaves out") {
  const Outcome three = shakebed("check " + rough);
  CHECK(three.code == 0);
  for (const char* part :
       {"100 rough grains in 3 dimensions", "W = 22.36", "x, y, z", "spin about x, y and z",
        "viscous-Coulomb", "memory of contacts", "grain-grain", "grain-base", "t_c/50",
        "engine        events", "omega t_c", "largest overlap", "CPU seconds", "discard",
        "measure 300 cycles"}) {
    CAPTURE(part);
    CHECK_THAT(three.output, Catch::Contains(part));
  }
  const Outcome two = shakebed("check --set base.drive.frequency_rpm=300 " + smooth);
  CHECK(two.code == 0);
  for (const char* part : {"40 smooth grains in 2 dimensions", "spin and any tangential force",
                           "the third coordinate", "stays at rest"}) {
    CAPTURE(part);
    CHECK_THAT(two.output, Catch::Contains(part));
  }
}

TEST_CASE("A scene with faults exits with 2 and lists all of them") {
  const Outcome outcome =
      shakebed("check " + rough + " --set grains.restitution=0 --set cell=[5,1] --set colour=red");
  CHECK(outcome.code == 2);
  CHECK_THAT(outcome.output, Catch::Contains("--set grains.restitution=0: ") &&
                                 Catch::Contains("--set cell=[5,1]: ") &&
                                 Catch::Contains("--set colour=red: unknown key `colour`"));
  CHECK(shakebed("check no/such/scene.yaml").code == 2);
}

TEST_CASE("The table of keys and the JSON schema are printed") {
  CHECK_THAT(shakebed("check --keys").output, Catch::Contains("| `base.drive.W` | number |"));
  CHECK_THAT(shakebed("check --schema").output,
             Catch::Contains("\"fraction_of_contact_duration\""));
}

}  // namespace
