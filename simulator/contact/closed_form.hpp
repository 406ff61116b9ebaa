#pragma once

#include <cmath>

#include "simulator/contact/contact_kind.hpp"

namespace shakebed::simulator {

/// Exact normal motion of a linear spring-dashpot contact that begins at closing speed v:
///   delta(t) = (v/omega_d) exp(-gamma t) sin(omega_d t),
/// gamma = c_n/(2 m_eff), omega_d^2 = k_n/m_eff - gamma^2, until t_c = pi/omega_d, when the speed
/// is -e v. Everything is given per unit of v: the duration does not depend on it.
class ClosedNormal {
 public:
  explicit ClosedNormal(const ContactKind& kind)
      : gamma_(kind.normal_damping / (2 * kind.effective_mass)),
        omega_(M_PI / kind.contact_duration()),
        duration_(kind.contact_duration()),
        restitution_(std::exp(-gamma_ * duration_)) {
    const double turn = std::atan2(omega_, gamma_);
    largest_overlap_ = overlap(turn / omega_);
    // The force k delta + c delta' vanishes before the overlap does; there the impulse is largest.
    const double natural = kind.stiffness / kind.effective_mass;
    const double pull = std::atan2(2 * gamma_ * omega_, 2 * gamma_ * gamma_ - natural) / omega_;
    largest_impulse_ = impulse_fraction(std::min(pull, duration_));
  }

  double duration() const { return duration_; }                ///< t_c
  double restitution() const { return restitution_; }          ///< e
  double largest_overlap() const { return largest_overlap_; }  ///< per closing speed
  /// Largest share of the final impulse reached on the way: 1 and a little, since the dashpot
  /// pulls.
  double largest_impulse_fraction() const { return largest_impulse_; }

  double overlap(double t) const { return std::exp(-gamma_ * t) * std::sin(omega_ * t) / omega_; }
  double closing_speed(double t) const {
    return std::exp(-gamma_ * t) * (std::cos(omega_ * t) - gamma_ / omega_ * std::sin(omega_ * t));
  }
  /// Share of the normal impulse (1 + e) m_eff v given by time t.
  double impulse_fraction(double t) const { return (1 - closing_speed(t)) / (1 + restitution_); }
  /// F_n / (m_eff v) = -d(closing speed)/dt.
  double force(double t) const {
    const double decay = std::exp(-gamma_ * t);
    const double s = std::sin(omega_ * t);
    const double c = std::cos(omega_ * t);
    return decay * (2 * gamma_ * c + (omega_ - gamma_ * gamma_ / omega_) * s);
  }

 private:
  double gamma_;
  double omega_;
  double duration_;
  double restitution_;
  double largest_overlap_;
  double largest_impulse_;
};

}  // namespace shakebed::simulator
