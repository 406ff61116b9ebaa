#pragma once

#include <vector>

#include "simulator/contact/closed_form.hpp"
#include "simulator/contact/contact_kind.hpp"

namespace shakebed::simulator {

/// Tangential outcome of a whole viscous-Coulomb contact. In units of the closing speed v the slip
/// sigma = |v_t|/v obeys
///   d sigma/dt = -(7/2) min(c_t sigma / m_eff, mu |F_n| / (m_eff v)),
/// (7/2 = 1 + m_eff (R_i^2/I_i + ...) for solid spheres, also at a wall), with F_n(t) of the closed
/// normal solution. The slip keeps its direction, so that the outcome depends on one number, the
/// slip at touch q: a table in q, straight beyond the q from which the contact slides throughout.
/// Linear interpolation errs by less than 1e-6 v.
class SlidingTable {
 public:
  struct Outcome {
    double impulse;       ///< J_t / (m_eff v)
    double displacement;  ///< integral of (q - sigma(t)) dt over the contact, per unit v
  };

  SlidingTable(const ContactKind& kind, const ClosedNormal& normal);

  Outcome operator()(double q) const {
    if (q >= q_.back()) return last_;  // sliding throughout: nothing changes any more
    const double place = q / step_;
    const auto k = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(k);
    return {impulse_[k] + share * (impulse_[k + 1] - impulse_[k]),
            displacement_[k] + share * (displacement_[k + 1] - displacement_[k])};
  }

 private:
  static constexpr std::size_t entries = 1025;

  double step_;
  std::vector<double> q_;
  std::vector<double> impulse_;
  std::vector<double> displacement_;
  Outcome last_;
};

}  // namespace shakebed::simulator
