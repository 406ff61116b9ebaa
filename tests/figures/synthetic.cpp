#include "tests/figures/synthetic.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace shakebed::tests {
namespace {

struct System {
  const char* name;
  int dimension;
  int grains;
  double a, b, c;
  double peak;
};

// 2D and 3D rough: Table III of doi 10.1063/1.4944795, algebraic form.
constexpr System systems[] = {{"2D smooth", 2, 40, 0.36, 0.9, 3.0, 4.0},
                              {"2D rough", 2, 40, 0.282, 0.656, 2.07, 4.5},
                              {"3D smooth", 3, 100, 0.13, 0.75, 6.0, 4.2},
                              {"3D rough", 3, 100, 0.054, 0.622, 7.98, 5.0}};

double decay(const System& system, double W) {
  return system.a * (1 + system.c * std::pow(W, -system.b));
}

double scaled_temperature(const System& system, double W) {
  if (W < 1) return 0;
  if (W >= system.peak) return decay(system, W);
  return decay(system, system.peak) * (W - 1) / (system.peak - 1);
}

// Scatter with unit variance that needs no random numbers: an equidistributed angle's cosine.
double scatter(int point, int column) {
  const double turns = std::fmod((point + 1) * std::numbers::phi + column * 0.37, 1.0);
  return std::numbers::sqrt2 * std::cos(2 * std::numbers::pi * turns);
}

struct Quantity {
  std::string name;
  std::string unit;
  double share;  ///< of twice T_z_scaled
};

const std::vector<Quantity> quantities = {
    {"T_z_twice_scaled", "m V_p^2", 1},     {"T_x_twice_scaled", "m V_p^2", 0.55},
    {"T_twice_scaled", "m V_p^2", 0.75},    {"T_z_scaled", "m V_p^2", 0.5},
    {"T_x_scaled", "m V_p^2", 0.275},       {"T_scaled", "m V_p^2", 0.375},
    {"T_z_volume_scaled", "m V_p^2", 0.48}, {"delta_h_cm_scaled", "V_p^2/g", 0.9}};

}  // namespace

files::CsvTable synthetic_canonical_table() {
  std::vector<files::CsvColumn> columns = {
      {"system", ""},       {"frequency_rpm", "rpm"}, {"W", "1"},     {"Gamma", "1"},
      {"V_p", "sqrt(g d)"}, {"layers", "1"},          {"grains", "1"}};
  for (const auto& quantity : quantities) {
    columns.push_back({quantity.name, quantity.unit});
    columns.push_back({quantity.name + "_se", quantity.unit});
  }
  for (const char* name : {"stationary", "at_rest", "replicates", "cycles"}) {
    columns.push_back({name, "1"});
  }
  columns.push_back({"reason", ""});

  files::CsvTable table(columns);
  table.name = "synthetic";
  table.provenance = {"synthetic: made from formulas for tests, not a measurement"};
  int point = 0;
  for (const auto& system : systems) {
    for (int rpm = 300; rpm <= 4000; rpm += 100, ++point) {
      const double omega = rpm * 2 * std::numbers::pi / 60;
      const double W = 0.005 * omega * omega / 9.81;
      const bool at_rest = W < 1;
      const bool plug = rpm == 500 && std::string(system.name).ends_with("rough");
      std::vector<std::string> row = {system.name,
                                      std::to_string(rpm),
                                      files::number_text(W),
                                      files::number_text(W),
                                      files::number_text(std::sqrt(W)),
                                      "4",
                                      std::to_string(system.grains)};
      for (std::size_t i = 0; i < quantities.size(); ++i) {
        const double exact = quantities[i].share * scaled_temperature(system, W);
        const double error = 0.01 * exact;
        row.push_back(files::number_text(exact + error * scatter(point, static_cast<int>(i))));
        row.push_back(files::number_text(plug ? 0.3 * exact : error));
      }
      row.insert(row.end(), {plug ? "0.5" : "1", at_rest ? "1" : "0", "2", "1200",
                             plug ? "halves of the run differ by 5.1 standard errors" : ""});
      table.add_row(row);
    }
  }
  return table;
}

}  // namespace shakebed::tests
