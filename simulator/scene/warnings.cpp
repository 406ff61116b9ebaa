#include "simulator/scene/warnings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "files/csv.hpp"
#include "simulator/scene/accuracy.hpp"
#include "simulator/scene/step_bias.hpp"

namespace shakebed::simulator {

namespace {

constexpr double coarse_fraction = 0.1;  // dt/t_c
constexpr double large_overlap = 0.05;   // d
constexpr double soft_angle = 0.1;       // rad

/// Bound on the bias of T_z that k_n of `auto` leaves; it goes as k_n^(-1/2).
double bias_of_automatic_stiffness() {
  for (const auto& setting : accuracy_table().stiffness) {
    if (setting.value == 1) return setting.bias_bound;
  }
  return 0;
}

/// What the measured bed most like this one says of a coarse step.
std::string step_bias_text(const Scene& scene, const Parameters& parameters) {
  const StepLaw& law = nearest_step_law(scene, parameters);
  const double x = std::pow(scene.protocol.time_step_fraction, 2);
  char text[240];
  std::snprintf(text, sizeof text,
                "dt above t_c/10 (%.3g t_c): T_z is off by about %.2g %% (+- %.1g), as on the "
                "measured bed most like this one (%s: %dD, %s, W = %.3g, N = %.3g, e = %.3g); 0.02 "
                "is the default",
                scene.protocol.time_step_fraction, 100 * law.coefficient * x, 100 * law.error * x,
                law.scene.c_str(), law.dimension, law.rough ? "rough" : "smooth", law.W, law.layers,
                law.restitution);
  return text;
}

std::string rounded(double value) { return files::rounded_text(value, 3); }

}  // namespace

double expected_largest_overlap(const Scene& scene, const Parameters& parameters) {
  const double impact = 2 * scene.base.drive.peak_velocity() *
                        std::sqrt(parameters.grain_base.effective_mass / parameters.stiffness);
  const double at_rest = scene.grains.layers * scene.gravity / parameters.stiffness;
  return impact + at_rest;
}

double drive_angle_in_contact(const Scene& scene, const Parameters& parameters) {
  return scene.base.drive.angular_frequency * std::max(parameters.grain_grain.contact_duration(),
                                                       parameters.grain_base.contact_duration());
}

std::vector<std::string> scene_warnings(const Scene& scene, const Parameters& parameters) {
  std::vector<std::string> warnings;
  const auto warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  if (scene.protocol.time_step_fraction > coarse_fraction) {
    warn(step_bias_text(scene, parameters));
  }
  if (scene.accuracy) {
    if (const auto why = outside_calibration(scene); !why.empty()) {
      warn("the bounds behind `accuracy` were not measured on such beds: " + why +
           "; take them as a guess");
    }
  }
  if (const double overlap = expected_largest_overlap(scene, parameters); overlap > large_overlap) {
    const double softness = std::sqrt(automatic_stiffness(scene) / parameters.stiffness);
    warn("overlaps up to about " + rounded(overlap) +
         " d are to be expected; T_z may be off that of hard grains by up to " +
         rounded(100 * bias_of_automatic_stiffness() * softness) +
         " % (measured for overlaps below 0.05 d); hard grains need a larger contact.stiffness");
  }
  const double advised = automatic_stiffness(scene);
  if (const auto k_n = scene.contact.stiffness;
      k_n && scene.grains.layers > usual_layers && *k_n < advised / 2) {
    warn("contact.stiffness = " + rounded(*k_n) + " is soft for a bed of " +
         rounded(scene.grains.layers) +
         " layers at this V_p, whose weight and momentum rest on its " +
         "lowest grains; `auto` would take " + rounded(advised));
  }
  if (const double angle = drive_angle_in_contact(scene, parameters); angle > soft_angle) {
    warn("a contact lasts " + rounded(angle) +
         " rad of the drive's cycle: the softness of the grains shapes the result");
  }
  if (scene.never_thrown()) {
    warn("Gamma = " + rounded(scene.Gamma()) +
         " < 1: the base never leaves the bed behind, so the bed stays at rest and T_z is 0");
  }
  if (scene.elastic()) {
    warn("nothing dissipates energy (e = 1, no friction): the bed heats up without end");
  }
  if (scene.grains.count == 1) {
    warn("one grain has no velocity relative to the mean of all grains: its T is 0");
  }
  // A grain thrown at V_p flies for 2 V_p/g, which is Gamma/pi cycles; fewer than about 30 of
  // these do not let a standard error be judged.
  const double flight = std::max(1.0, scene.flight_time() / scene.base.drive.period());
  if (const auto& cycles = scene.protocol.cycles;
      cycles && static_cast<double>(*cycles) < 30 * flight && !scene.never_thrown()) {
    warn(std::to_string(*cycles) + " measured cycles are few: 30 flights of the bed take about " +
         rounded(std::ceil(30 * flight)) + ", so standard errors will be rough");
  }
  if (const long most = scene.protocol.at_most;
      scene.protocol.until && !scene.never_thrown() && static_cast<double>(most) < 30 * flight) {
    warn("at_most = " + std::to_string(most) +
         " cycles are few: 30 flights of the bed take about " + rounded(std::ceil(30 * flight)) +
         ", so standard errors will be rough");
  }
  return warnings;
}

std::vector<std::string> column_warnings(const ColumnParameters& parameters) {
  constexpr double little = 0.1;
  std::vector<std::string> warnings;
  for (const auto& kind : parameters.kinds) {
    if (std::isinf(kind.contact_duration)) {
      warnings.push_back(kind.name +
                         " contacts are over-damped: grains stick together until they are pulled "
                         "apart; lower gamma_n or raise the stiffness");
    } else if (kind.restitution < little) {
      warnings.push_back(kind.name +
                         " contacts are close to over-damped: e = " + rounded(kind.restitution));
    }
  }
  return warnings;
}

}  // namespace shakebed::simulator
