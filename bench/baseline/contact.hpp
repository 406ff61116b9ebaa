#pragma once

#include <algorithm>
#include <cmath>

#include "simulator/contact/contact_kind.hpp"
#include "simulator/dimension.hpp"

// Frozen on 2026-11-22: the contact law as one contact at a time evaluated it. Part of the
// benchmarks' baseline, which does not follow the simulator.
namespace shakebed::baseline {

using simulator::ContactKind;
using simulator::cross;
using simulator::moment;
using simulator::Spin;
using simulator::Vector;

/// Repulsive normal force F_n = k_n delta + c_n v_n, with delta the overlap and v_n the closing
/// speed (Bhateja 2016, Eq. A5). It may pull near the end of a contact: the contact ends at
/// delta = 0, which makes the restitution coefficient exact.
struct LinearSpringDashpot {
  double stiffness;  ///< k_n
  double damping;    ///< c_n

  explicit LinearSpringDashpot(const ContactKind& kind)
      : stiffness(kind.stiffness), damping(kind.normal_damping) {}

  double force(double overlap, double closing_speed) const {
    return stiffness * overlap + damping * closing_speed;
  }
  double dissipated_power(double closing_speed) const {
    return damping * closing_speed * closing_speed;
  }
  double stored_energy(double overlap) const { return 0.5 * stiffness * overlap * overlap; }
};

/// Tangential dashpot capped by Coulomb friction, no memory (Bhateja 2016, Eq. A8, read as the
/// smaller magnitude along the slip direction): F_t = min(c_t |v_t|, mu |F_n|).
struct ViscousCoulomb {
  static constexpr bool turns_grains = true;

  double damping;   ///< c_t
  double friction;  ///< mu

  explicit ViscousCoulomb(const ContactKind& kind)
      : damping(kind.tangential_damping), friction(kind.friction) {}

  /// F_t / |v_t|: the force is minus this times the slip velocity.
  double force_over_slip(double slip_speed, double normal_force) const {
    // No branch: which of the two wins is unpredictable in a shaken bed.
    return std::min(damping, friction * std::abs(normal_force) / slip_speed);
  }
};

/// No tangential force: grains carry no spin.
struct Frictionless {
  static constexpr bool turns_grains = false;

  explicit Frictionless(const ContactKind&) {}
};

/// What a contact does to grain i; grain j (or the base) receives minus the force and, because
/// both lever arms point at the contact, the same moment n x F_t times its own radius.
template <int D>
struct ContactForce {
  Vector<D> force;            ///< on i
  Spin<D> moment_per_radius;  ///< n x F_t; a grain of radius R is turned by R times this
  double dissipated_power;    ///< >= 0
};

/// Normal and tangential law of one contact kind.
template <int D, class Normal, class Tangential>
struct Contact {
  Normal normal;
  Tangential tangential;

  explicit Contact(const ContactKind& kind) : normal(kind), tangential(kind) {}

  /// Bhateja 2016, Eqs. A3-A8. `n` points from i to j; `v` = v_i - v_j of the centres;
  /// `spin_radius` = omega_i R_i + omega_j R_j, so that the slip velocity is
  /// v_t = v - (v.n) n + spin_radius x n.
  // Inlined by force: through memory its small vectors cost more than its arithmetic.
  [[gnu::always_inline]] inline ContactForce<D> operator()(const Vector<D>& n, double overlap,
                                                           const Vector<D>& v,
                                                           const Spin<D>& spin_radius) const {
    const double closing_speed = v.dot(n);
    const double normal_force = normal.force(overlap, closing_speed);
    ContactForce<D> result{-normal_force * n, Spin<D>::Zero(),
                           normal.dissipated_power(closing_speed)};
    if constexpr (Tangential::turns_grains) {
      const Vector<D> slip = v - closing_speed * n + cross<D>(spin_radius, n);
      const double slip_speed = slip.norm();
      if (slip_speed > 0) {
        const double ratio = tangential.force_over_slip(slip_speed, normal_force);
        const Vector<D> tangential_force = -ratio * slip;
        result.force += tangential_force;
        result.moment_per_radius = moment<D>(n, tangential_force);
        result.dissipated_power += ratio * slip_speed * slip_speed;
      }
    }
    return result;
  }
};

}  // namespace shakebed::baseline
