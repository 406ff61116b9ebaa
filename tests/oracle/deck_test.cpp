#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "cli/lammps_column_deck.hpp"
#include "cli/lammps_deck.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/scene/read_scene.hpp"

namespace {

using namespace shakebed;

simulator::Scene scene(int dimension = 3) {
  const std::string cell = dimension == 3 ? "[4, 6]" : "[10]";
  const auto root = files::YamlNode::load_text(
      "scene: 1\ndimension: " + std::to_string(dimension) +
          "\ngrains: {count: 20, restitution: 0.95, friction: 0.6}\ncell: " + cell +
          "\nbase: {drive: {W: 10, amplitude: 1.5}, restitution: 0.7, friction: 0.1}\n"
          "contact: {stiffness: 5e4}\nprotocol: {measure: {cycles: 7}}\n",
      "test");
  return simulator::read_scene(root);
}

std::vector<std::string> words_after(const std::string& deck, const std::string& start) {
  const auto at = deck.find("\n" + start);
  REQUIRE(at != std::string::npos);
  std::istringstream line(deck.substr(at + 1 + start.size(), deck.find('\n', at + 1) - at - 1));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  return words;
}

/// The restitution of a contact of LAMMPS' parameters, from its equation of motion
/// m_eff x'' = -k x - gamma m_eff x': e = exp(-gamma t_c/2), t_c = pi/sqrt(k/m_eff - gamma^2/4).
double restitution(double stiffness, double gamma, double effective_mass) {
  const double t_c = std::numbers::pi / std::sqrt(stiffness / effective_mass - gamma * gamma / 4);
  return std::exp(-gamma * t_c / 2);
}

}  // namespace

TEST_CASE("Pair and base have the restitution and friction of the scene") {
  const std::string deck = cli::lammps_deck(scene(), "test");
  const auto pair = words_after(deck, "pair_style gran/hooke ");
  const auto base = words_after(deck, "fix base all wall/gran hooke ");
  CHECK(restitution(std::stod(pair[0]), std::stod(pair[2]), 0.5) == Approx(0.95).epsilon(1e-12));
  CHECK(restitution(std::stod(base[0]), std::stod(base[2]), 1.0) == Approx(0.7).epsilon(1e-12));
  CHECK(std::stod(pair[4]) == 0.6);
  CHECK(std::stod(base[4]) == 0.1);
  SECTION("c_t = c_n of each kind") {
    CHECK(pair[3] == pair[2]);
    CHECK(base[3] == base[2]);
  }
}

TEST_CASE("Without friction nothing turns the grains") {
  auto smooth = scene();
  smooth.contact.tangential = simulator::TangentialLaw::frictionless;
  const std::string deck = cli::lammps_deck(smooth, "test");
  for (const char* start : {"pair_style gran/hooke ", "fix base all wall/gran hooke "}) {
    const auto words = words_after(deck, start);
    CHECK(words[3] == "0");
    CHECK(words[4] == "0");
  }
}

TEST_CASE("The deck steps at t_c/75 or finer, in equal phases") {
  for (const double fraction : {0.02, 0.005}) {
    auto fine = scene();
    fine.protocol.time_step_fraction = fraction;
    const std::string deck = cli::lammps_deck(fine, "test");
    const auto steps = std::stol(words_after(deck, "variable steps_per_cycle index ")[0]);
    const double t_c = simulator::bind_parameters(fine).contact_duration;
    CHECK(steps % 64 == 0);
    CHECK(fine.base.drive.period() / static_cast<double>(steps) <=
          t_c * std::min(fraction, 1. / 75));
  }
}

TEST_CASE("The cycles and the base are those of the scene") {
  const auto here = scene();
  const std::string deck = cli::lammps_deck(here, "test");
  CHECK(words_after(deck, "variable cycles index ")[0] == "7");
  CHECK(std::stol(words_after(deck, "variable transient_cycles index ")[0]) ==
        simulator::automatic_transient(here));
  const double A = std::stod(words_after(deck, "variable amplitude index ")[0]);
  const double period = std::stod(words_after(deck, "variable period index ")[0]);
  CHECK(A == 1.5);
  CHECK(std::pow(A * 2 * std::numbers::pi / period, 2) == Approx(10));  // W
}

TEST_CASE("Two dimensions are x and y in LAMMPS, with spheres") {
  const std::string deck = cli::lammps_deck(scene(2), "test");
  CHECK(deck.find("\ndimension 2\nboundary p fs p\n") != std::string::npos);
  CHECK(deck.find("enforce2d") != std::string::npos);
  CHECK(deck.find("vector 0 -1 0") != std::string::npos);
  CHECK(deck.find("wiggle y") != std::string::npos);
  CHECK(deck.find("disc") == std::string::npos);
}

TEST_CASE("Every grain starts inside the cell, and none touches another or the base") {
  const auto here = scene();
  std::istringstream deck(cli::lammps_deck(here, "test"));
  std::vector<std::array<double, 3>> grains;
  for (std::string line; std::getline(deck, line);) {
    const std::string start = "create_atoms 1 single ";
    if (!line.starts_with(start)) continue;
    std::istringstream numbers(line.substr(start.size()));
    auto& r = grains.emplace_back();
    numbers >> r[0] >> r[1] >> r[2];
  }
  REQUIRE(grains.size() == 20);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    CHECK(grains[i][2] > 0.5 - here.base.drive.amplitude);
    for (std::size_t j = 0; j < i; ++j) {
      double r2 = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        double x = grains[i][c] - grains[j][c];
        if (c < 2) x -= here.cell[c] * std::nearbyint(x / here.cell[c]);
        r2 += x * x;
      }
      CHECK(r2 > 1);
    }
  }
}

namespace {

simulator::Scene column(const std::string& normal = "linear_spring_dashpot",
                        const std::string& more = "") {
  const auto root = files::YamlNode::load_text(
      "scene: 1\ndimension: 3\ncontainer: {cylinder: {diameter: 6}, wall: {friction: 0.4, gamma_t: "
      "20}}\ngrains: {count: 30, friction: 0.5, sizes: [0.9, 1.1], large: {diameter: 2, "
      "density_ratio: 7}}\nbase: {drive: {frequency: 0.1, amplitude: 7.5}}\ncontact: {normal: " +
          normal +
          ", stiffness: 2e5, gamma_n: 40, tangential: {law: cundall_strack}}\n"
          "protocol: {measure: {cycles: 2}}\n" +
          more,
      "test");
  return simulator::read_scene(root);
}

}  // namespace

TEST_CASE("A deck of a bed in a cylinder has its springs, walls, grains and drag") {
  const std::string deck = cli::lammps_column_deck(
      column("linear_spring_dashpot", "drag: {background: 0.24}\n"), "test");
  // The first pair_style is without friction; the last is the scene's.
  CHECK(words_after(deck, "pair_style gran/hooke/history ")[4] == "0");
  const auto last = deck.rfind("\npair_style gran/hooke/history ");
  const auto pair = words_after(deck.substr(last), "pair_style gran/hooke/history ");
  CHECK(std::stod(pair[0]) == 2e5);
  CHECK(std::stod(pair[1]) == Approx(2e5 * 2 / 7));
  CHECK(pair[2] == "40");
  CHECK(pair[3] == "0");
  CHECK(pair[4] == "0.5");
  const auto side =
      words_after(deck.substr(deck.rfind("\nfix side")), "fix side all wall/gran hooke/history ");
  CHECK(side[3] == "20");
  CHECK(side[4] == "0.4");
  CHECK(side[6] == "zcylinder");
  CHECK(side[7] == "3");
  CHECK(side[8] == "wiggle");
  CHECK(words_after(deck, "fix drag all viscous ")[0] == "0.24");
  const auto large = words_after(deck, "set atom 1 diameter ");
  CHECK(std::stod(large[0]) == 2);
  CHECK(std::stod(large[2]) == Approx(7 * 6 / std::numbers::pi));
  CHECK(std::stod(words_after(deck, "set atom 31 diameter ")[0]) >= 0.9);
  CHECK(deck.find("set atom 32 ") == std::string::npos);
}

TEST_CASE("A bed that LAMMPS cannot have is refused with the reason") {
  CHECK_THROWS_WITH(cli::lammps_column_deck(column("hertz"), "test"),
                    Catch::Contains("sqrt(delta R_eff)"));
  CHECK_THROWS_WITH(
      cli::lammps_column_deck(column("linear_spring_dashpot", "drag: {air: 0.01}\n"), "test"),
      Catch::Contains("drag.air"));
}
