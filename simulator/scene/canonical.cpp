#include <cmath>

#include "files/csv.hpp"
#include "simulator/scene/column.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::simulator {

namespace {

using files::number_text;

/// The shortest percentage that reads back as this fraction. Dividing by 100 rounds, so the
/// product alone may miss by a unit in the last place.
std::string percent_text(double fraction) {
  const double guess = fraction * 100;
  double below = guess;
  double above = guess;
  for (int step = 0; step < 4; ++step) {
    for (const double candidate : {below, above}) {
      if (candidate / 100 == fraction) return number_text(candidate) + " %";
    }
    below = std::nextafter(below, 0.0);
    above = std::nextafter(above, 2 * guess);
  }
  return number_text(guess) + " %";
}

std::string list_text(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_text(value);
  return "[" + text + "]";
}

/// Nothing for a bed with a base alone: its text, and with it its key, is older than walls.
std::string walls_text(const Scene& scene) {
  std::string text;
  if (scene.base.direction == DriveDirection::x) text += "  moves_along: x\n";
  const auto surface = [&text](double restitution, double friction) {
    text += "  restitution: " + number_text(restitution) + "\n";
    text += "  friction: " + number_text(friction) + "\n";
  };
  if (scene.lid) {
    text += "lid:\n  height: " + number_text(scene.lid->height) + "\n";
    text += std::string("  moves: ") + (scene.lid->moves_with_base ? "with_base" : "fixed") + "\n";
    surface(scene.lid->restitution, scene.lid->friction);
  }
  if (scene.side_walls) {
    text += "side_walls:\n  across: x\n";
    surface(scene.side_walls->restitution, scene.side_walls->friction);
  }
  return text;
}

std::string tangential_text(const Scene::Contact& contact) {
  if (contact.tangential == TangentialLaw::frictionless) return " frictionless\n";
  std::string damping = "c_n";
  if (contact.damping == TangentialDamping::critical) damping = "critical";
  if (contact.damping == TangentialDamping::value) damping = number_text(contact.damping_value);
  return "\n    law: viscous_coulomb\n    damping: " + damping + "\n";
}

std::string measure_text(const Scene::Protocol& protocol) {
  const std::string errors = protocol.cautious_errors ? "    errors: cautious\n" : "";
  if (protocol.cycles) return errors + "    cycles: " + std::to_string(*protocol.cycles) + "\n";
  return errors + "    until:\n      " + protocol.until->quantity + ": " +
         percent_text(protocol.until->fraction) +
         "\n    at_most: " + std::to_string(protocol.at_most) + "\n";
}

std::string protocol_text(const Scene::Protocol& protocol) {
  std::string text = "protocol:\n  settle: ";
  text += protocol.settle ? number_text(*protocol.settle) : "auto";
  text += "\n  transient:";
  text += protocol.transient ? "\n    cycles: " + std::to_string(*protocol.transient) : " auto";
  text += "\n  measure:\n" + measure_text(protocol);
  text += "  time_step:\n    fraction_of_contact_duration: ";
  text += number_text(protocol.time_step_fraction) + "\n";
  if (protocol.allow_coarse_time_step) text += "    allow_coarse: true\n";
  constexpr const char* engines[] = {"auto", "uniform", "events"};
  constexpr const char* contacts[] = {"auto", "fine", "closed"};
  text += std::string("  engine: ") + engines[static_cast<int>(protocol.engine)] + "\n";
  text += std::string("  contacts: ") + contacts[static_cast<int>(protocol.contacts)] + "\n";
  const bool in_base_frame = protocol.profile.frame == Scene::ProfileChoice::Frame::base;
  const auto& profile = protocol.profile;
  if (in_base_frame || profile.instant || profile.phase) text += "  profile:\n";
  if (in_base_frame) text += "    frame: base\n";
  if (profile.instant) text += "    instant: true\n";
  if (profile.phase) text += "    phase: true\n";
  const auto& snapshots = protocol.snapshots;
  if (!snapshots.phases.empty()) {
    text += "  snapshots:\n    phases: " + list_text(snapshots.phases) + "\n";
    text += "    cycles: " + std::to_string(snapshots.cycles) + "\n";
  }
  return text;
}

}  // namespace

std::string canonical_yaml(const Scene& scene) {
  if (scene.column) return canonical_column_yaml(scene);
  std::string text = "scene: 1\n";
  text += "dimension: " + std::to_string(scene.dimension) + "\n";
  text += "gravity: " + number_text(scene.gravity) + "\n";
  text += "grains:\n";
  text += "  count: " + std::to_string(scene.grains.count) + "\n";
  text += "  restitution: " + number_text(scene.grains.restitution) + "\n";
  text += "  friction: " + number_text(scene.grains.friction) + "\n";
  text += "cell: " + list_text(scene.cell) + "\n";
  text += "base:\n  drive:\n";
  text += "    amplitude: " + number_text(scene.base.drive.amplitude) + "\n";
  text += "    angular_frequency: " + number_text(scene.base.drive.angular_frequency) + "\n";
  text += "  restitution: " + number_text(scene.base.restitution) + "\n";
  text += "  friction: " + number_text(scene.base.friction) + "\n";
  text += walls_text(scene);
  text += "contact:\n  normal: linear_spring_dashpot\n  stiffness: ";
  text += scene.contact.stiffness ? number_text(*scene.contact.stiffness) : "auto";
  if (scene.contact.allow_soft) text += "\n  allow_soft: true";
  text += "\n  tangential:" + tangential_text(scene.contact);
  text += protocol_text(scene.protocol);
  text += "seed: " + std::to_string(scene.seed) + "\n";
  return text;
}

}  // namespace shakebed::simulator
