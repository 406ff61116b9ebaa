#pragma once

#include "simulator/contact/contact_kind.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// What a scene's words come to: stiffness, damping and time step as numbers.
struct Parameters {
  ContactKind grain_grain;
  ContactKind grain_base;
  ContactKind grain_lid;        ///< when the scene has a lid
  ContactKind grain_side_wall;  ///< when it has side walls
  double stiffness;             ///< k_n [m g/d]
  double contact_duration;      ///< t_c of the shortest contact kind [sqrt(d/g)]
  double time_step;             ///< dt [sqrt(d/g)]; divides the drive's period
  long steps_per_cycle;         ///< a multiple of phases_per_cycle
  bool turns_grains;            ///< some contact kind has friction
};

/// Equal phases of the drive at which averages are sampled, each cycle. (Near phase 0 T_z is 2.4
/// times its mean, so that one extra sample there would bias T_z by 2-3 %.)
inline constexpr long phases_per_cycle = 64;

/// k_n when the scene says auto: 2e4 max(1, N/4) max(m V_p^2/min(A, d)^2, m g/d). The first term
/// holds impact overlaps near V/sqrt(2e4) V_p ~ 1 % d and omega t_c constant; the second static
/// overlaps; N/4 the column that a deep bed stacks on one contact.
double automatic_stiffness(const Scene& scene);

Parameters bind_parameters(const Scene& scene);

/// Cycles discarded when the scene says `transient: auto`: the bed, thrown as a plug at the start,
/// flies for about (1 + e) W d/(pi A) cycles, or to the lid and back; several flights are let pass.
long automatic_transient(const Scene& scene);

}  // namespace shakebed::simulator
