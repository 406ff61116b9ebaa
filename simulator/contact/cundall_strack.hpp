#pragma once

#include <cmath>
#include <experimental/simd>

#include "simulator/contact/chosen.hpp"
#include "simulator/contact/spring_kind.hpp"
#include "simulator/contact/triple.hpp"

namespace shakebed::simulator {

/// Tangential spring with memory (Cundall & Strack 1979; Sun 2006, Eqs. 4 and 6):
///   F_t = f (-k_t u - gamma_t m_eff v_t),  |F_t| <= mu |F_n| by truncating u,
///   du/dt = v_t - (u . v) r/r^2,  u = 0 when the contact begins.
/// The last term turns u with the contact: to the order of the step it takes away what of u sticks
/// out of the new tangent plane, which is how it is done here, so that u never drifts out of it.
/// Exchanging the two grains changes the sign of u.
struct CundallStrack {
  static constexpr bool turns_grains = true;

  template <class Real>
  using Memory = Triple<Real>;

  double stiffness;  ///< k_t [m g/d]
  double rate;       ///< gamma_t [sqrt(g/d)]
  double friction;   ///< mu

  explicit CundallStrack(const SpringKind& kind)
      : stiffness(kind.tangential_stiffness), rate(kind.tangential_rate), friction(kind.friction) {}

  /// F_t on i after u has been carried over a step dt. `n` is the unit normal, `factor` = f.
  template <class Real>
  [[gnu::always_inline]] Triple<Real> force(Triple<Real>& u, const Triple<Real>& n,
                                            const Triple<Real>& slip, const Real& normal_force,
                                            const Real& factor, const Real& effective_mass,
                                            double dt) const {
    using std::sqrt;
    u += Real(dt) * slip;
    u -= dot(u, n) * n;
    const Real damping = Real(rate) * effective_mass;
    Triple<Real> force = Real(-stiffness) * u - damping * slip;
    force = factor * force;
    const Real cap = Real(friction) * normal_force;
    const Real square = dot(force, force);
    const auto slides = square > cap * cap;
    if (any(slides)) {
      const Real magnitude = sqrt(cap * cap / chosen(slides, square, Real(1)));
      const Real share = chosen(slides, magnitude, Real(1));
      const Real dashpot = damping / Real(stiffness);
      force = share * force;
      u = share * u - ((Real(1) - share) * dashpot) * slip;
    }
    return force;
  }

 private:
  static bool any(bool condition) { return condition; }
  template <class Mask>
  static bool any(const Mask& condition) {
    return std::experimental::any_of(condition);
  }
};

}  // namespace shakebed::simulator
