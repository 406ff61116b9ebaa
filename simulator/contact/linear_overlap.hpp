#pragma once

namespace shakebed::simulator {

/// The linear law: f(delta/d) = 1 in Sun 2006, Eqs. 5 and 6.
struct LinearOverlap {
  template <class Real>
  static Real factor(const Real&) {
    return Real(1);
  }
  /// Elastic energy of the normal spring, integral of f k_n delta: k_n delta^2/2.
  static double stored_energy(double stiffness, double overlap, double) {
    return 0.5 * stiffness * overlap * overlap;
  }
};

}  // namespace shakebed::simulator
