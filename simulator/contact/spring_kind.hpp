#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace shakebed::simulator {

/// Parameters of a spring contact between grains, or between a grain and a wall, in the form of
/// Silbert et al., Phys. Rev. E 64, 051302 (2001), as Sun et al., Phys. Rev. E 74, 061307 (2006),
/// Eqs. 5 and 6 have it: forces are gamma m_eff v, so that one gamma serves grains of any mass.
struct SpringKind {
  double normal_stiffness;      ///< k_n [m g/d]
  double tangential_stiffness;  ///< k_t [m g/d]
  double normal_rate;           ///< gamma_n [sqrt(g/d)]
  double tangential_rate;       ///< gamma_t [sqrt(g/d)]
  double friction;              ///< mu

  /// t_c = pi (k_n/m_eff - gamma_n^2/4)^(-1/2) of the linear law (Sun 2006, Eq. 10, whose print
  /// lacks the pi); infinite when the contact is over-damped.
  double contact_duration(double effective_mass) const {
    const double square = normal_stiffness / effective_mass - 0.25 * normal_rate * normal_rate;
    return square > 0 ? std::numbers::pi / std::sqrt(square)
                      : std::numeric_limits<double>::infinity();
  }
  /// e = exp(-gamma_n t_c/2) of the linear law (Sun 2006, Eq. 9); 0 when over-damped.
  double restitution(double effective_mass) const {
    return std::exp(-0.5 * normal_rate * contact_duration(effective_mass));
  }
};

}  // namespace shakebed::simulator
