#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "files/csv.hpp"
#include "files/error.hpp"
#include "fitting/networks/analysis.hpp"
#include "tests/networks/packing.hpp"

using namespace shakebed::tests;
namespace networks = shakebed::fitting::networks;
using shakebed::cli::network_command;
using shakebed::cli::NetworkOptions;

namespace {

class Command {
 public:
  Command()
      : folder_(std::filesystem::temp_directory_path() /
                ("shakebed-network-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    options.grains = folder_ / "grains.csv";
    options.contacts = folder_ / "contacts.csv";
    options.json = (folder_ / "out.json").string();
    options.csv_folder = folder_ / "tables";
  }
  ~Command() { std::filesystem::remove_all(folder_); }
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  void give(const std::string& grains, const std::string& contacts) const {
    std::ofstream(*options.grains) << grains;
    std::ofstream(*options.contacts) << contacts;
  }
  nlohmann::json run() const {
    REQUIRE(network_command(options) == 0);
    return nlohmann::json::parse(std::ifstream(*options.json));
  }
  bool wrote_something() const {
    return std::filesystem::exists(*options.json) || std::filesystem::exists(*options.csv_folder);
  }

  NetworkOptions options;

 private:
  std::filesystem::path folder_;
};

std::string text(double value) { return shakebed::files::number_text(value); }

}  // namespace

TEST_CASE("the JSON of a bed holds what its contract says") {
  const auto bed = packing({.small_grains = 900, .cylinder_diameter = 7}, 71);
  const Command command;
  // Rows in reverse, ids made large and sparse: neither may matter.
  std::string grains = "id,x,y,z,radius\n", contacts = "i,j,normal_force\n";
  const auto id = [](auto k) { return std::to_string(7'000'000'000 - 13 * static_cast<long>(k)); };
  for (std::size_t k = 0; k < bed.grains(); ++k) {
    const auto& [x, y, z] = bed.position[k];
    grains +=
        id(k) + "," + text(x) + "," + text(y) + "," + text(z) + "," + text(bed.radius[k]) + "\n";
  }
  for (auto k = bed.contacts.size(); k-- > 0;) {
    const auto& contact = bed.contacts[k];
    contacts += id(contact.j) + "," + id(contact.i) + "," + text(contact.normal_force) + "\n";
    if (k % 100 == 0) contacts += id(contact.i) + ",," + text(2.5) + "\n";
  }
  command.give(grains, contacts);
  const auto json = command.run();
  const auto direct = networks::analyse(bed, {});
  const auto& largest = direct.networks.networks.front();

  CHECK(json["networks"] == direct.networks.networks.size());
  CHECK(json["largest"]["grains"] == largest.grains.size());
  CHECK(json["largest"]["contacts"] == largest.contacts.size());
  CHECK(json["largest"]["coordination"].get<double>() == Approx(largest.coordination));
  CHECK(json["largest"]["strong_grains"] == largest.strong_grains);
  CHECK(json["largest"]["extent"].get<double>() == Approx(largest.extent).epsilon(1e-14));
  CHECK(json["mean_force"].get<double>() == Approx(direct.networks.mean_force).epsilon(1e-12));
  for (const char* method : {"histogram", "likelihood"}) {
    const auto& fit = json["pdf"][method];
    const auto& expected =
        std::string(method) == "histogram" ? direct.all.by_histogram : direct.all.by_likelihood;
    CHECK(fit["a"].get<double>() == Approx(expected.law.a).epsilon(1e-6));
    CHECK(fit["b"].get<double>() == Approx(expected.law.b).epsilon(1e-6));
    CHECK(fit["beta"].get<double>() == Approx(expected.law.beta).epsilon(1e-6));
    REQUIRE(fit["covariance"].size() == 3);
    for (std::size_t p = 0; p < 3; ++p) {
      REQUIRE(fit["covariance"][p].size() == 3);
      for (std::size_t q = 0; q < 3; ++q) {
        CHECK(fit["covariance"][p][q].get<double>() ==
              Approx(expected.covariance[p][q]).epsilon(1e-4));
      }
    }
  }
  REQUIRE(json["mst"].size() == 5);
  for (std::size_t pass = 0; pass < 5; ++pass) {
    const auto& row = direct.contacting.passes[pass];
    CHECK(json["mst"][pass]["NP"] == row.NP);
    CHECK(json["mst"][pass]["NE"] == row.NE);
    CHECK(json["mst"][pass]["NT"] == row.NT);
    CHECK(json["mst"][pass]["NE_rest"] == row.NE_rest);
    CHECK(json["mst"][pass]["missing"] == row.missing);
  }
  CHECK(json["contacts"]["with_walls"] > 0);
  CHECK(shakebed::files::CsvTable::read(*command.options.csv_folder / "passes.csv").rows() == 6);
}

TEST_CASE("an empty contact list is a defined result") {
  const Command command;
  command.give("id,x,y,z,radius\n1,0,0,0,0.5\n2,0,0,3,0.5\n", "i,j,normal_force\n");
  const auto json = command.run();
  CHECK(json["networks"] == 0);
  CHECK(json["largest"]["grains"] == 0);
  CHECK(json["mean_force"] == 0);
  CHECK(json["pdf"]["likelihood"]["beta"].is_null());
  CHECK(json["mst"][4]["NP"] == 0);
  CHECK(json["warnings"].size() == 1);
}

TEST_CASE("contacts of grains that do not touch are counted in a warning") {
  const Command command;
  command.give("id,x,y,z,radius\n1,0,0,0,0.5\n2,0,0,1.2,0.5\n3,0,0,2.1,0.5\n",
               "i,j,normal_force\n1,2,3\n2,3,4\n");
  const auto json = command.run();
  REQUIRE(json["warnings"].size() == 1);
  CHECK(json["warnings"][0].get<std::string>().starts_with("1 of 2 contacts"));
}

TEST_CASE("bad input writes nothing") {
  Command command;
  SECTION("a bad row") {
    command.give("id,x,y,z,radius\n1,0,0,0,0.5\n2,0,0,nan,0.5\n", "i,j,normal_force\n1,2,1\n");
  }
  SECTION("a bad contact") {
    command.give("id,x,y,z,radius\n1,0,0,0,0.5\n2,0,0,1,0.5\n", "i,j,normal_force\n1,3,1\n");
  }
  SECTION("a bad option") {
    command.give("id,x,y,z,radius\n1,0,0,0,0.5\n2,0,0,1,0.5\n", "i,j,normal_force\n1,2,1\n");
    command.options.elongation = 0.5;
  }
  CHECK_THROWS_AS(network_command(command.options), shakebed::files::Error);
  CHECK(!command.wrote_something());
}
