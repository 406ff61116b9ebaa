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
template <int D, class Number = double>
struct ContactForce {
  Vector<D, Number> force;            ///< on i
  Spin<D, Number> moment_per_radius;  ///< n x F_t; a grain of radius R is turned by R times this
  Number dissipated_power;            ///< >= 0
};

/// Normal and tangential law of one contact kind.
template <int D, NormalContactLaw Normal, TangentialContactLaw Tangential>
struct Contact {
  Normal normal;
  Tangential tangential;

  explicit Contact(const ContactKind& kind) : normal(kind), tangential(kind) {}

  /// Bhateja 2016, Eqs. A3-A8. `n` points from i to j; `v` = v_i - v_j of the centres;
  /// `spin_radius` = omega_i R_i + omega_j R_j, so that the slip velocity is
  /// v_t = v - (v.n) n + spin_radius x n. One contact, or (Number = Lanes) one in each lane.
  // Inlined by force: through memory its small vectors cost more than its arithmetic.
  template <class Number = double>
  [[gnu::always_inline]] inline ContactForce<D, Number> operator()(
      const std::type_identity_t<Vector<D, Number>>& n, const Number& overlap,
      const std::type_identity_t<Vector<D, Number>>& v,
      const std::type_identity_t<Spin<D, Number>>& spin_radius) const {
    return (*this)(n, overlap, v, spin_radius, Number(v.dot(n)));
  }

  /// The same, to whom v.n is known already.
  template <class Number>
  [[gnu::always_inline]] inline ContactForce<D, Number> operator()(
      const std::type_identity_t<Vector<D, Number>>& n, const Number& overlap,
      const std::type_identity_t<Vector<D, Number>>& v,
      const std::type_identity_t<Spin<D, Number>>& spin_radius, const Number& closing_speed) const {
    const Number normal_force = normal.force(overlap, closing_speed);
    ContactForce<D, Number> result{n * Number(-normal_force), Spin<D, Number>::Zero(),
                                   normal.dissipated_power(closing_speed)};
    if constexpr (Tangential::turns_grains) {
      const Vector<D, Number> slip = v - n * closing_speed + cross<D, Number>(spin_radius, n);
      const Number slip_squared = slip.squaredNorm();
      const Number ratio = tangential.force_over_slip(slip_squared, normal_force);
      const Vector<D, Number> tangential_force = slip * Number(-ratio);
      result.force += tangential_force;
      result.moment_per_radius = moment<D, Number>(n, tangential_force);
      result.dissipated_power += ratio * slip_squared;
    }
    return result;
  }
};

}  // namespace shakebed::simulator
