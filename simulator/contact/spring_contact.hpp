#pragma once

#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/spring_kind.hpp"
#include "simulator/contact/triple.hpp"

namespace shakebed::simulator {

/// What a contact law is told, for one contact or one SIMD vector of them. `normal` points from
/// grain j (or the wall) to grain i.
template <class Real>
struct ContactState {
  Triple<Real> normal;
  Real overlap;               ///< delta = a_i + a_j - |r_i - r_j|, > 0
  Real size;                  ///< d = a_i + a_j; at a wall 2 a_i
  Real effective_mass;        ///< m_i m_j/(m_i + m_j); at a wall m_i
  Triple<Real> velocity;      ///< v_i - v_j of the centres (at a wall: of its surface)
  Triple<Real> rim_velocity;  ///< a_i omega_i + a_j omega_j
};

/// Force on grain i; j receives minus it. A grain of radius a is turned by -a times the moment,
/// i and j alike, since both lever arms point at the contact (Sun 2006, Eq. 8).
template <class Real>
struct SpringForce {
  Triple<Real> force;
  Triple<Real> moment;  ///< n x F_t
  Real normal_force;    ///< F_n along the normal; negative where the dashpot pulls
  Triple<Real> tangential_force;
};

/// Normal and tangential law of one contact kind in the form of Sun 2006, Eqs. 3-6:
///   F_n = f(delta/d) (k_n delta - gamma_n m_eff v_n) n,  v_n = (v . n),
///   v_t = v - v_n n - (a_i omega_i + a_j omega_j) x n.
/// The contact ends at zero overlap, also while the dashpot pulls. `Overlap` is f; `Tangential` is
/// CundallStrack, or Frictionless, which has no memory.
template <class Overlap, class Tangential>
struct SpringContact {
  static constexpr bool turns_grains = Tangential::turns_grains;

  SpringKind kind;
  Tangential tangential;

  explicit SpringContact(const SpringKind& parameters) : kind(parameters), tangential(parameters) {}

  /// Carries `memory` over a step dt (0: leaves it but for the truncation) and gives the force.
  template <class Real, class Memory>
  [[gnu::always_inline]] SpringForce<Real> operator()(const ContactState<Real>& c, Memory& memory,
                                                      double dt) const {
    const Triple<Real>& n = c.normal;
    const Real speed = dot(c.velocity, n);
    const Real factor = Overlap::factor(c.overlap / c.size);
    const Real normal_force = factor * (Real(kind.normal_stiffness) * c.overlap -
                                        Real(kind.normal_rate) * c.effective_mass * speed);
    SpringForce<Real> result{normal_force * n, {}, normal_force, {}};
    if constexpr (turns_grains) {
      const Triple<Real> slip = c.velocity - speed * n - cross(c.rim_velocity, n);
      result.tangential_force =
          tangential.force(memory, n, slip, normal_force, factor, c.effective_mass, dt);
      result.force += result.tangential_force;
      result.moment = cross(n, result.tangential_force);
    }
    return result;
  }
};

}  // namespace shakebed::simulator
