#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "files/csv.hpp"
#include "tests/fitting/table3.hpp"

namespace shakebed::fitting {

/// A collected table of rough beds, 300 to 5000 rpm, that follow Table III's algebraic forms past
/// W = 2 with 1 % errors, rise from rest at W = 1, and rise like W^0.7 in height.
inline files::CsvTable collected_table(double relative_error, unsigned long seed) {
  const auto random = random_stream(seed);
  files::CsvTable table({{"system", ""},
                         {"frequency_rpm", "rpm"},
                         {"W", "1"},
                         {"V_p", "sqrt(g d)"},
                         {"T_z", "m g d"},
                         {"T_z_se", "m g d"},
                         {"T_z_scaled", "m V_p^2"},
                         {"T_z_scaled_se", "m V_p^2"},
                         {"T_z_twice_scaled", "m V_p^2"},
                         {"T_z_twice_scaled_se", "m V_p^2"},
                         {"delta_h_cm", "d"},
                         {"delta_h_cm_se", "d"},
                         {"stationary", "1"},
                         {"at_rest", "1"}});
  table.name = "collected.csv";
  table.provenance = {"sweep: synthetic"};
  const auto text = files::number_text;
  for (const auto& row : table3()) {
    if (row.model.name != "algebraic") continue;
    for (int rpm = 300; rpm <= 5000; rpm += 100) {
      const double W = W_at(rpm);
      const bool rest = W < 1;
      const double rise = rest ? 0 : std::min(1.0, W - 1);
      const double clean = rise * row.model.value(W, row.abc);
      const double error = rest ? 0 : relative_error * clean;
      const double y = clean + gsl_ran_gaussian(random.get(), error);
      const double h = rest ? 0 : 1.5 * std::pow(W, 0.7);
      table.add_row({row.system, text(rpm), text(W), text(std::sqrt(W)), text(y * W / 2),
                     text(error * W / 2), text(y / 2), text(error / 2), text(y), text(error),
                     text(h), text(0.01 * h), "1", rest ? "1" : "0"});
    }
  }
  return table;
}

/// `table` with one cell changed.
inline files::CsvTable with_cell(const files::CsvTable& table, std::size_t row,
                                 const std::string& column, const std::string& value) {
  files::CsvTable changed(table.columns());
  changed.name = table.name;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < table.columns().size(); ++c) cells.push_back(table.text(r, c));
    if (r == row) cells[table.column(column)] = value;
    changed.add_row(std::move(cells));
  }
  return changed;
}

}  // namespace shakebed::fitting
