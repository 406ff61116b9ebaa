#include "simulator/contact/parameters.hpp"

#include <algorithm>
#include <cmath>

namespace shakebed::simulator {
namespace {

ContactKind bind_kind(const Scene& scene, double effective_mass, double restitution,
                      double friction, double stiffness) {
  ContactKind kind{effective_mass, stiffness, 0, 0, friction, restitution};
  kind.normal_damping = normal_damping_for(restitution, stiffness, effective_mass);
  switch (scene.contact.damping) {
    case TangentialDamping::as_normal:
      kind.tangential_damping = kind.normal_damping;
      break;
    case TangentialDamping::critical:
      kind.tangential_damping = critical_damping_for(stiffness, effective_mass);
      break;
    case TangentialDamping::value:
      kind.tangential_damping = scene.contact.damping_value;
      break;
  }
  return kind;
}

}  // namespace

double automatic_stiffness(const Scene& scene) {
  const Drive& drive = scene.base.drive;
  const double length = std::min(drive.amplitude, 1.0);
  const double impact = drive.peak_velocity() * drive.peak_velocity() / (length * length);
  return 2e4 * std::max(1.0, scene.grains.layers / 4) * std::max(impact, scene.gravity);
}

Parameters bind_parameters(const Scene& scene) {
  Parameters p{};
  p.stiffness = scene.contact.stiffness.value_or(automatic_stiffness(scene));
  p.grain_grain =
      bind_kind(scene, 0.5, scene.grains.restitution, scene.grains.friction, p.stiffness);
  p.grain_base = bind_kind(scene, 1, scene.base.restitution, scene.base.friction, p.stiffness);
  p.contact_duration = std::min(p.grain_grain.contact_duration(), p.grain_base.contact_duration());
  const auto bind_wall = [&](const auto& wall) {
    const auto kind = bind_kind(scene, 1, wall.restitution, wall.friction, p.stiffness);
    p.contact_duration = std::min(p.contact_duration, kind.contact_duration());
    return kind;
  };
  if (scene.lid) p.grain_lid = bind_wall(*scene.lid);
  if (scene.side_walls) p.grain_side_wall = bind_wall(*scene.side_walls);
  const double period = scene.base.drive.period();
  const double wanted = scene.protocol.time_step_fraction * p.contact_duration;
  p.steps_per_cycle =
      phases_per_cycle * std::max(1L, std::lround(std::ceil(period / (wanted * phases_per_cycle))));
  p.time_step = period / static_cast<double>(p.steps_per_cycle);
  p.turns_grains = scene.contact.tangential != TangentialLaw::frictionless && scene.any_friction();
  return p;
}

long automatic_transient(const Scene& scene) {
  const double flight_cycles = scene.lid ? scene.flight_time() / scene.base.drive.period()
                                         : scene.base.drive.peak_velocity() *
                                               scene.base.drive.angular_frequency /
                                               (M_PI * scene.gravity);
  return 20 + static_cast<long>(std::ceil(6 * flight_cycles));
}

}  // namespace shakebed::simulator
