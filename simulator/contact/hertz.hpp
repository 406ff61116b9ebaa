#pragma once

#include <cmath>
#include <experimental/simd>

namespace shakebed::simulator {

/// Hertzian contacts with viscous damping: f(delta/d) = sqrt(delta/d) in Sun 2006, Eqs. 5 and 6,
/// d being the sum of the radii. At a wall, whose diameter is infinite, delta/d would vanish: there
/// d is the grain's own diameter (our reading). Other codes use sqrt(delta R_eff) with
/// R_eff = R_i R_j/d; for equal grains that is f sqrt(d^2)/2, for unequal ones no single k_n maps
/// one to the other.
///
/// Without damping a head-on contact at closing speed v lasts 3.218 (m_eff/K)^(2/5) v^(-1/5), with
/// F = K delta^(3/2), K = k_n/sqrt(d) (Landau & Lifshitz, Theory of Elasticity, sec. 9).
struct HertzOverlap {
  template <class Real>
  static Real factor(const Real& overlap_share) {
    using std::sqrt;
    return sqrt(overlap_share);
  }
  /// (2/5) k_n delta^(5/2) d^(-1/2).
  static double stored_energy(double stiffness, double overlap, double size) {
    return 0.4 * stiffness * overlap * overlap * std::sqrt(overlap / size);
  }
};

}  // namespace shakebed::simulator
