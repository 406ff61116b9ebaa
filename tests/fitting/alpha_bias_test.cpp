#include "fitting/trade/alpha_bias.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace {

using namespace shakebed;
using namespace shakebed::fitting;
using files::number_text;

files::CsvTable empty_table() {
  return files::CsvTable({{"scene", ""},
                          {"axis", ""},
                          {"value", "1"},
                          {"dimension", "1"},
                          {"rough", "1"},
                          {"W", "1"},
                          {"layers", "1"},
                          {"restitution", "1"},
                          {"amplitude", "d"},
                          {"T_z", "m g d"},
                          {"T_z_se", "m g d"}});
}

void add(files::CsvTable& table, const std::string& axis, double value, double W, double T_z,
         const std::string& layers = "4") {
  table.add_row({"W" + number_text(W), axis, number_text(value), "3", "1", number_text(W), layers,
                 "0.9", "1", number_text(T_z), number_text(0.01 * T_z)});
}

TEST_CASE("The exponent at each setting is that of its scenes, its bias that to the reference") {
  auto table = empty_table();
  for (const double W : {2.0, 6.0, 24.0, 96.0}) {  // the first is below the peak
    const double odd = W < 5 ? 7 : 1;
    add(table, "reference", 50, W, odd * std::pow(W, 0.7));
    add(table, "dt closed", 5, W, odd * std::pow(W, 0.65));
    add(table, "k_n", 1, W, odd * std::pow(W, 0.72));
    add(table, "k_n", 30, W, odd * std::pow(W, 0.7));
  }
  add(table, "dt closed", 5, 30, 1e3, "2");  // another family
  const auto biases = trade::alpha_biases(table);
  REQUIRE(biases.size() == 4);
  CHECK(biases[0].alpha == Approx(1.4));
  CHECK(biases[1].bias == Approx(-0.1));
  CHECK(biases[2].bias == Approx(0.04));
  CHECK(std::isnan(biases[3].bias_error));
  // ln W is spread by -ln 4, 0, ln 4: sigma = 2 * 0.01 sqrt(2) ln 4/(2 ln^2 4).
  CHECK(biases[1].error == Approx(0.01 * std::sqrt(2) / std::log(4)));
  CHECK(biases[1].bias_error == Approx(std::sqrt(2) * biases[1].error));
}

TEST_CASE("A setting that a scene lacks has no exponent, and two scenes have none") {
  auto table = empty_table();
  for (const double W : {6.0, 24.0}) add(table, "reference", 50, W, W);
  CHECK(trade::alpha_biases(table).empty());
  add(table, "reference", 50, 96, 96);
  add(table, "dt closed", 5, 24, 24);
  CHECK(trade::alpha_biases(table).size() == 1);
}

}  // namespace
