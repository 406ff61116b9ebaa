#pragma once

#include <cmath>
#include <numbers>
#include <optional>

#include "simulator/bed.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/motion/uniform.hpp"

namespace shakebed::tests {

using simulator::cross;
using simulator::row;
using simulator::set_row;
using simulator::Spin;
using simulator::Vector;

/// What two grains, or a grain and the still base, are made of.
struct Material {
  double stiffness = 1e6;
  double restitution = 0.9;
  double friction = 0;
  /// c_t; not given: each contact kind's own c_n.
  std::optional<double> tangential_damping = {};
};

/// Physics bound as a bed's are (so that a wrong effective mass shows), but on a still base and
/// with a time step of our own.
template <class Physics>
Physics still_world(const Material& material, double gravity, double time_step) {
  simulator::Scene scene;
  scene.dimension = Physics::dimension;
  scene.cell.assign(Physics::dimension - 1, 4.0);
  scene.grains.count = 2;
  scene.grains.restitution = scene.base.restitution = material.restitution;
  scene.grains.friction = scene.base.friction = material.friction;
  scene.contact.stiffness = material.stiffness;
  scene.contact.tangential = simulator::TangentialLaw::viscous_coulomb;
  if (material.tangential_damping) {
    scene.contact.damping = simulator::TangentialDamping::value;
    scene.contact.damping_value = *material.tangential_damping;
  }
  Physics physics = simulator::bind_physics<Physics>(scene, simulator::bind_parameters(scene));
  physics.base = {0, 0};
  physics.gravity = gravity;
  physics.time_step = time_step;
  return physics;
}

enum class Partner { grain, base };

constexpr double effective_mass(Partner partner) { return partner == Partner::grain ? 0.5 : 1; }

/// Half a period of the damped oscillator delta'' + 2 gamma delta' + omega_0^2 delta = 0 whose
/// e = exp(-gamma t_c): t_c = sqrt((pi^2 + ln^2 e) m_eff / k_n).
inline double contact_duration(const Material& m, Partner partner) {
  const double log_e = std::log(m.restitution);
  return std::sqrt((std::numbers::pi * std::numbers::pi + log_e * log_e) * effective_mass(partner) /
                   m.stiffness);
}

/// One impact at unit closing speed. `gap` over dt is the entry phase in (0, 1): the share of the
/// first step that passes before the touch.
struct Entry {
  double phase;
  double steps_per_contact = 50;  ///< t_c / dt
  double slip = 0;                ///< slip speed at the touch, all of it from spin
};

/// State after the contact, in terms of the contact: velocity and spin relative to the partner.
template <int D, bool TurnsGrains>
struct Impact {
  Vector<D> normal;     ///< from the grain to its partner
  Vector<D> velocity;   ///< of the grain relative to its partner
  Vector<D> slip;       ///< v - (v.n) n + (omega_i R_i + omega_j R_j) x n
  Spin<D> spin_change;  ///< of the grain
  double duration;      ///< steps in contact times dt
  double energy_lost;   ///< change of the bed's energy plus the ledger's dissipation
  simulator::Grains<D, TurnsGrains> before, after;

  double restitution() const { return -velocity.dot(normal); }
};

template <int D>
Vector<D> oblique() {
  if constexpr (D == 2) return {0.6, 0.8};
  if constexpr (D == 3) return {0.48, 0.6, 0.64};
}

/// A spin whose slip velocity omega x n at radius 1 is a unit vector, oblique in 3D.
template <int D>
Spin<D> unit_slip_spin(const Vector<D>& n) {
  if constexpr (D == 2) return Spin<D>(1.0);
  if constexpr (D == 3) return n.cross(Vector<D>(0.36, -0.8, 0.48)).normalized();
}

template <class Physics>
auto collide(const Material& material, Partner partner, const Entry& entry) {
  constexpr int D = Physics::dimension;
  constexpr double R = simulator::grain_radius;
  using State = typename Physics::GrainState;
  const double dt = contact_duration(material, partner) / entry.steps_per_contact;
  const double gap = entry.phase * dt;

  Impact<D, Physics::turns_grains> impact{};
  impact.normal = Vector<D>::Zero();
  impact.normal[D - 1] = -1;
  if (partner == Partner::grain) impact.normal = oblique<D>();
  const auto& n = impact.normal;

  State& start = impact.before;
  start.resize_to(partner == Partner::grain ? 2 : 1);
  Vector<D> place = Vector<D>::Constant(7);
  if (partner == Partner::grain) {
    set_row(start.position, 0, Vector<D>(place - (R + gap / 2) * n));
    set_row(start.position, 1, Vector<D>(place + (R + gap / 2) * n));
    set_row(start.velocity, 0, Vector<D>(0.5 * n));
    set_row(start.velocity, 1, Vector<D>(-0.5 * n));
  } else {
    place[D - 1] = R + gap;
    set_row(start.position, 0, place);
    set_row(start.velocity, 0, n);
  }
  if constexpr (Physics::turns_grains) {
    const double share = entry.slip / (R * static_cast<double>(start.count()));
    for (std::size_t i = 0; i < start.count(); ++i) {
      set_row(start.spin, i, Spin<D>(share * unit_slip_spin<D>(n)));
    }
  }

  simulator::UniformStepper<Physics> stepper(still_world<Physics>(material, 0, dt), start);
  const double energy = stepper.energy();
  long steps = 0;
  for (long previous = -1; steps == 0 || steps != previous;) {
    previous = steps;
    stepper.advance(1);
    steps = stepper.ledger().contact_steps;
  }
  State& end = impact.after;
  end = stepper.synchronised();
  impact.duration = static_cast<double>(steps) * dt;
  impact.energy_lost = energy - stepper.energy() - stepper.ledger().dissipation;
  impact.velocity = row(end.velocity, 0);
  Vector<D> n_end = n;  // slip turns a pair by v_t t_c
  if (partner == Partner::grain) {
    impact.velocity -= row(end.velocity, 1);
    n_end = (row(end.position, 1) - row(end.position, 0)).normalized();
  }
  impact.slip = impact.velocity - impact.velocity.dot(n_end) * n_end;
  if constexpr (Physics::turns_grains) {
    Spin<D> turn = R * row(end.spin, 0);
    if (partner == Partner::grain) turn += R * row(end.spin, 1);
    impact.slip += cross<D>(turn, n_end);
    impact.spin_change = row(end.spin, 0) - row(start.spin, 0);
  }
  return impact;
}

/// Mean over equally likely entry phases. A contact's force jumps at touch and at parting, so that
/// a single impact is only first order in dt.
template <class Quantity>
double entry_phase_average(int phases, Quantity quantity) {
  double sum = 0;
  for (int k = 0; k < phases; ++k) sum += quantity((k + 0.5) / phases);
  return sum / phases;
}

template <int D>
using Smooth = simulator::BedPhysics<D, simulator::Frictionless>;
template <int D>
using Rough = simulator::BedPhysics<D, simulator::ViscousCoulomb>;

/// Mean energy lost in a smooth collision at unit speed over that of the closed form, 1 - e^2.
inline double loss_ratio(double e, double steps) {
  const double kept = entry_phase_average(2000, [&](double phase) {
    const double out = collide<Smooth<2>>({1e6, e}, Partner::grain, {phase, steps}).restitution();
    return out * out;
  });
  return (1 - kept) / (1 - e * e);
}

}  // namespace shakebed::tests
