#pragma once

#include <concepts>

#include "simulator/contact/contact_kind.hpp"
#include "simulator/dimension.hpp"

namespace shakebed::simulator {

template <class Law>
concept NormalContactLaw = requires(const Law law, double x) {
  { law.force(x, x) } -> std::same_as<double>;
  { law.dissipated_power(x) } -> std::same_as<double>;
  { law.stored_energy(x) } -> std::same_as<double>;
};

/// A law that turns grains states `force_over_slip`; one that does not has no tangential force.
template <class Law>
concept TangentialContactLaw = requires {
  { Law::turns_grains } -> std::convertible_to<bool>;
}
&&(!Law::turns_grains || requires(const Law law, double x) {
  { law.force_over_slip(x, x) } -> std::same_as<double>;
});

/// What a contact does to grain i; grain j (or the base) receives minus the force and, because
/// both lever arms point at the contact, the same moment n x F_t times its own radius.
template <int D>
struct ContactForce {
  Vector<D> force;            ///< on i
  Spin<D> moment_per_radius;  ///< n x F_t; a grain of radius R is turned by R times this
  double dissipated_power;    ///< >= 0
};

/// Normal and tangential law of one contact kind.
template <int D, NormalContactLaw Normal, TangentialContactLaw Tangential>
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

}  // namespace shakebed::simulator
