#include "cli/check_accuracy.hpp"

#include <cmath>
#include <cstdio>
#include <optional>

#include "simulator/scene/accuracy.hpp"

namespace shakebed::cli {
namespace {

using simulator::AccuracyChoice;
using simulator::AccuracySetting;

double cost_of(const std::vector<AccuracySetting>& settings, double value) {
  for (const auto& setting : settings) {
    if (setting.value == value) return setting.relative_cost;
  }
  return std::nan("");
}

/// CPU time beside a run that reduces noise alone to 1 % at dt = t_c/50 and k_n of `auto`.
double relative_time(const AccuracyChoice& choice) {
  const auto& table = simulator::accuracy_table();
  return cost_of(table.steps, choice.steps_in_contact) *
         cost_of(table.stiffness, choice.stiffness_factor.value_or(1)) *
         std::pow(0.01 / choice.standard_error, 2);
}

std::string row(const std::string& asked, const AccuracyChoice& choice) {
  char text[200];
  std::snprintf(text, sizeof text, "| `%s` | %.2g %% | t_c/%g | %g | %.2g %% | %.2g %% | %.2g |\n",
                asked.c_str(), 100 * choice.promise(), choice.steps_in_contact,
                choice.stiffness_factor.value_or(1), 100 * choice.bias_bound,
                100 * choice.standard_error, relative_time(choice));
  return text;
}

}  // namespace

std::string accuracy_markdown() {
  std::string text =
      "| `accuracy:` | promise (95 %) | dt | k_n over `auto` | bias at most | standard error | CPU "
      "time |\n|---|---|---|---|---|---|---|\n";
  for (const char* word : {"draft", "standard", "reference"}) {
    text += row(word, simulator::accuracy_preset(word, false));
  }
  for (const int percent : {1, 2, 3, 5, 10, 20}) {
    if (const auto choice = simulator::choose_accuracy(0.01 * percent, false)) {
      text += row("{T_z: " + std::to_string(percent) + " %}", *choice);
    }
  }
  return text;
}

}  // namespace shakebed::cli
