#pragma once

#include <algorithm>
#include <cmath>

#include "simulator/contact/contact_kind.hpp"

namespace shakebed::simulator {

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

}  // namespace shakebed::simulator
