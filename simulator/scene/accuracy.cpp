#include "simulator/scene/accuracy.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "files/csv.hpp"
#include "simulator/contact/parameters.hpp"

namespace shakebed::simulator {
namespace {

constexpr double normal_95_percent = 1.96;

/// A cap on cycles that precision rather than patience should reach.
constexpr long accuracy_at_most = 200000;

struct Preset {
  const char* word;
  double steps_in_contact;
  double stiffness_factor;
  double standard_error;
};
// Hard grains and fine steps throughout: in closed form they cost no more (docs/accuracy.md), so
// that presets differ in how long they measure.
constexpr std::array presets{Preset{"draft", 20, 30, 0.04}, Preset{"standard", 50, 30, 0.01},
                             Preset{"reference", 50, 30, 0.003}};

const AccuracySetting& setting_of(const std::vector<AccuracySetting>& settings, double value) {
  for (const auto& setting : settings) {
    if (std::abs(setting.value - value) < 1e-9 * value) return setting;
  }
  throw files::failed("data/trade/accuracy.csv", "has no row for " + files::number_text(value));
}

/// The given stiffness is the user's bed, not an approximation to it.
const std::vector<AccuracySetting>& stiffness_choices(bool given) {
  static const std::vector<AccuracySetting> as_given{{1, 0, 1}};
  return given ? as_given : accuracy_table().stiffness;
}

constexpr std::array decided_by_accuracy{"protocol.measure.cycles", "protocol.measure.until",
                                         "protocol.time_step", "protocol.engine",
                                         "protocol.contacts"};

void apply(Scene& scene, const AccuracyChoice& choice, double asked) {
  auto& protocol = scene.protocol;
  protocol.time_step_fraction = 1 / choice.steps_in_contact;
  protocol.cycles.reset();
  protocol.until = {"T_z", choice.standard_error};
  protocol.cautious_errors = true;
  if (choice.stiffness_factor) {
    scene.contact.stiffness = *choice.stiffness_factor * automatic_stiffness(scene);
  }
  scene.accuracy = {asked, choice.bias_bound};
}

}  // namespace

std::optional<AccuracyChoice> choose_accuracy(double bound, bool stiffness_given) {
  std::optional<AccuracyChoice> best;
  double least = INFINITY;
  for (const auto& steps : accuracy_table().steps) {
    for (const auto& stiffness : stiffness_choices(stiffness_given)) {
      const double bias = steps.bias_bound + stiffness.bias_bound;
      if (bias >= bound) continue;
      const double cost = steps.relative_cost * stiffness.relative_cost / std::pow(bound - bias, 2);
      if (cost >= least) continue;
      least = cost;
      best = {steps.value, std::nullopt, bias, (bound - bias) / normal_95_percent};
      if (!stiffness_given) best->stiffness_factor = stiffness.value;
    }
  }
  return best;
}

AccuracyChoice accuracy_preset(const std::string& word, bool stiffness_given) {
  for (const auto& preset : presets) {
    if (word != preset.word) continue;
    AccuracyChoice choice{preset.steps_in_contact, std::nullopt,
                          setting_of(accuracy_table().steps, preset.steps_in_contact).bias_bound,
                          preset.standard_error};
    if (stiffness_given) return choice;
    choice.stiffness_factor = preset.stiffness_factor;
    choice.bias_bound += setting_of(accuracy_table().stiffness, preset.stiffness_factor).bias_bound;
    return choice;
  }
  throw files::bad_input("accuracy", "no preset is called `" + word + "`");
}

void read_accuracy(SceneValues& values, Scene& scene) {
  if (!values.given("accuracy") || values.refused("accuracy") || values.refused("accuracy.T_z")) {
    return;
  }
  for (const std::string path : decided_by_accuracy) {
    if (!values.given(path)) continue;
    values.report(path, "`" + path + "` is what `accuracy` decides; keep one of them");
  }
  if (scene.column || scene.walled()) {
    values.report("accuracy",
                  "`accuracy`: its bounds were measured on periodic beds over a base alone; with "
                  "walls write protocol.measure and protocol.time_step");
    return;
  }
  const bool stiffness_given = scene.contact.stiffness.has_value();
  if (!values.given("protocol.measure.at_most")) scene.protocol.at_most = accuracy_at_most;
  if (const auto word = values.word("accuracy")) {
    const auto choice = accuracy_preset(*word, stiffness_given);
    apply(scene, choice, choice.promise());
    return;
  }
  const auto asked = values.number("accuracy.T_z");
  if (!asked) {
    values.report("accuracy", "`accuracy` takes draft, standard, reference, or {T_z: 1 %}");
    return;
  }
  if (const auto choice = choose_accuracy(*asked, stiffness_given)) {
    apply(scene, *choice, *asked);
    return;
  }
  const auto best = choose_accuracy(1, stiffness_given);
  double least = best->bias_bound;
  for (const auto& steps : accuracy_table().steps) {
    for (const auto& stiffness : stiffness_choices(stiffness_given)) {
      least = std::min(least, steps.bias_bound + stiffness.bias_bound);
    }
  }
  char text[160];
  std::snprintf(text, sizeof text,
                "`accuracy.T_z`: %.3g %% is less than the bias that even the finest settings may "
                "leave, %.2g %%; ask for more than that",
                100 * *asked, 100 * least);
  values.report("accuracy.T_z", text);
}

std::string outside_calibration(const Scene& scene) {
  const double W = scene.W();
  const double restitution = scene.least_restitution();
  constexpr double rounding = 1e-9;  // W comes from an angular frequency
  if (W < 5 * (1 - rounding)) {
    return "W below 5 (at W = 2.5 the k_n of `auto` makes T_z 6 % too large, thirty times that 1 "
           "%)";
  }
  if (W > 90 * (1 + rounding)) return "W above 90";
  if (scene.grains.layers < 2 || scene.grains.layers > 8) return "N outside [2, 8]";
  if (restitution < 0.7) return "restitution below 0.7";
  if (scene.base.drive.amplitude < 0.3 || scene.base.drive.amplitude > 1) {
    return "A/d outside [0.3, 1]";
  }
  return "";
}

std::optional<ReachedAccuracy> reached_accuracy(const Scene& scene, const Record& record) {
  if (!scene.accuracy) return std::nullopt;
  ReachedAccuracy reached{scene.accuracy->asked, scene.accuracy->bias_bound, INFINITY,
                          record.at_rest};
  for (const auto& quantity : record.quantities) {
    if (quantity.name != "T_z") continue;
    reached.noise =
        normal_95_percent * quantity.estimate.standard_error / std::abs(quantity.estimate.mean);
  }
  return reached;
}

}  // namespace shakebed::simulator
