#include <array>
#include <cmath>

#include "files/csv.hpp"
#include "simulator/scene/admissible.hpp"

namespace shakebed::simulator {

namespace {

struct Told {
  std::optional<double> amplitude, angular_frequency, W, Gamma;
};

/// What one key comes to in reduced units. A physical frequency f is f sqrt(d/g) reduced.
void tell(Told& told, const std::string& name, double value, double diameter_mm,
          double gravity_si) {
  const double time_unit = std::sqrt(diameter_mm / 1000 / gravity_si);
  if (name == "W") told.W = value;
  if (name == "Gamma") told.Gamma = value;
  if (name == "frequency") told.angular_frequency = 2 * M_PI * value;
  if (name == "angular_frequency") told.angular_frequency = value;
  if (name == "frequency_rpm") told.angular_frequency = 2 * M_PI * value / 60 * time_unit;
  if (name == "frequency_hz") told.angular_frequency = 2 * M_PI * value * time_unit;
  if (name == "amplitude") told.amplitude = value;
  if (name == "amplitude_mm") told.amplitude = value / diameter_mm;
}

/// Solves W = (A omega)^2/(d g) and Gamma = A omega^2/g for A and omega, with d = g = 1.
std::optional<Drive> solved(const Told& told) {
  if (told.amplitude) {
    const double A = *told.amplitude;
    if (told.angular_frequency) return Drive{A, *told.angular_frequency};
    if (told.W) return Drive{A, std::sqrt(*told.W) / A};
    if (told.Gamma) return Drive{A, std::sqrt(*told.Gamma / A)};
  } else if (told.angular_frequency) {
    const double omega = *told.angular_frequency;
    if (told.W) return Drive{std::sqrt(*told.W) / omega, omega};
    if (told.Gamma) return Drive{*told.Gamma / (omega * omega), omega};
  } else if (told.W && told.Gamma) {
    return Drive{*told.W / *told.Gamma, *told.Gamma / std::sqrt(*told.W)};
  }
  return std::nullopt;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

bool usable(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

Drive drive_from(SceneValues& values, std::optional<double> diameter_mm, double gravity_si) {
  const std::string drive = "base.drive";
  if (values.refused(drive)) return {};
  const auto known = scene_keys_under(drive);
  std::vector<std::string> given;
  Told told;
  bool readable = true;
  for (const auto& name : known) {
    const std::string path = drive + "." + name;
    if (!values.given(path) && !values.refused(path)) continue;
    given.push_back(name);
    const auto value = values.number(path);
    const bool physical = name.ends_with("_mm") || name.ends_with("_rpm") || name.ends_with("_hz");
    if (!value) {
      readable = false;
    } else if (physical && !diameter_mm) {
      readable = false;
      values.report(path, "`" + path +
                              "` has a physical unit, so the scene must say how large a "
                              "grain is: units: {diameter: 5 mm}");
    } else {
      tell(told, name, *value, diameter_mm.value_or(1), gravity_si);
    }
  }
  if (given.size() != 2) {
    values.report(drive, "`base.drive` takes exactly two of " + joined(known) + "; got " +
                             (given.empty() ? "none" : joined(given)));
    return {};
  }
  if (!readable) return {};
  const auto solution = solved(told);
  if (!solution) {
    values.report(drive, "`base.drive`: " + joined(given) +
                             " say the same thing twice; replace one of them by another of " +
                             joined(known));
    return {};
  }
  // Beyond these neither a time step nor a run length can be found for a bed.
  if (!usable(solution->amplitude, 1e-6, 1e5) || !usable(solution->angular_frequency, 1e-4, 1e6)) {
    values.report(drive, "`base.drive` comes to A = " + files::number_text(solution->amplitude) +
                             " d and omega = " + files::number_text(solution->angular_frequency) +
                             " sqrt(g/d); expected A in [1e-6, 1e5] and omega in [1e-4, 1e6]");
    return {};
  }
  return *solution;
}

}  // namespace shakebed::simulator
