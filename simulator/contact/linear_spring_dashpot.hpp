#pragma once

#include "simulator/contact/contact_kind.hpp"

namespace shakebed::simulator {

/// Repulsive normal force F_n = k_n delta + c_n v_n, with delta the overlap and v_n the closing
/// speed (Bhateja 2016, Eq. A5). It may pull near the end of a contact: the contact ends at
/// delta = 0, which makes the restitution coefficient exact.
struct LinearSpringDashpot {
  double stiffness;  ///< k_n
  double damping;    ///< c_n

  explicit LinearSpringDashpot(const ContactKind& kind)
      : stiffness(kind.stiffness), damping(kind.normal_damping) {}

  template <class Number>
  Number force(const Number& overlap, const Number& closing_speed) const {
    return stiffness * overlap + damping * closing_speed;
  }
  template <class Number>
  Number dissipated_power(const Number& closing_speed) const {
    return damping * closing_speed * closing_speed;
  }
  double stored_energy(double overlap) const { return 0.5 * stiffness * overlap * overlap; }
};

}  // namespace shakebed::simulator
