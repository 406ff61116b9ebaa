#pragma once

#include <cmath>
#include <type_traits>

#include "simulator/contact/contact_kind.hpp"
#include "simulator/lanes.hpp"

namespace shakebed::simulator {

/// Tangential dashpot capped by Coulomb friction, no memory (Bhateja 2016, Eq. A8, read as the
/// smaller magnitude along the slip direction): F_t = min(c_t |v_t|, mu |F_n|).
struct ViscousCoulomb {
  static constexpr bool turns_grains = true;

  double damping;   ///< c_t
  double friction;  ///< mu

  explicit ViscousCoulomb(const ContactKind& kind)
      : damping(kind.tangential_damping), friction(kind.friction) {}

  /// F_t / |v_t|: the force is minus this times the slip velocity. Without slip the quotient is
  /// infinite or not a number, and the dashpot's (no force) is returned.
  template <class Number>
  Number force_over_slip(const Number& slip_squared, const Number& normal_force) const {
    using std::abs;
    using std::sqrt;
    const Number most = friction * abs(normal_force);
    // Which of the two wins is unpredictable in a shaken bed, but not along one contact, where the
    // root and the quotient are in the way of the next step.
    if constexpr (std::is_same_v<Number, Lane>) {
      if (all_of(damping * damping * slip_squared <= most * most)) return damping;
    }
    return smaller(Number(damping), Number(most / sqrt(slip_squared)));
  }
};

}  // namespace shakebed::simulator
