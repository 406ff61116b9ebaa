#pragma once

#include <cmath>
#include <numbers>

namespace shakebed::simulator {

/// Parameters of one kind of contact (grain-grain, or grain-base), bound once per scene.
///
/// Linear spring-dashpot: F_n = k_n delta - c_n d(-delta)/dt with
///   c_n = -2 ln(e) sqrt(k_n m_eff) / sqrt(pi^2 + ln(e)^2)
/// (Bhateja 2016, Eq. A9, whose printed sign is wrong: it would give c_n < 0 for e < 1), where the
/// contact ends at zero overlap, also while the dashpot pulls. Then e is exact, and the contact
/// lasts t_c = pi / sqrt(k_n/m_eff - (c_n / 2 m_eff)^2).
struct ContactKind {
  double effective_mass;      ///< m_eff [m]: 1/2 between grains, 1 at the base
  double stiffness;           ///< k_n [m g/d]
  double normal_damping;      ///< c_n [m sqrt(g/d)], force = c v
  double tangential_damping;  ///< c_t [m sqrt(g/d)], force = c v
  double friction;            ///< mu
  double restitution;         ///< e

  double contact_duration() const {
    const double half_rate = normal_damping / (2 * effective_mass);
    return std::numbers::pi / std::sqrt(stiffness / effective_mass - half_rate * half_rate);
  }
};

inline double normal_damping_for(double restitution, double stiffness, double effective_mass) {
  const double log_e = std::log(restitution);
  return -2 * log_e * std::sqrt(stiffness * effective_mass) /
         std::sqrt(std::numbers::pi * std::numbers::pi + log_e * log_e);
}

inline double critical_damping_for(double stiffness, double effective_mass) {
  return 2 * std::sqrt(stiffness * effective_mass);
}

}  // namespace shakebed::simulator
