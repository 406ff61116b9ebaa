#pragma once

#include <cmath>

#include "simulator/contact/triple.hpp"

namespace shakebed::simulator {

/// Upright side wall about the z axis, shaken together with the base and open above. Like the base
/// it meets grains as a grain of infinite mass and diameter would.
struct Cylinder {
  double radius;  ///< [d]

  /// Overlap of a sphere of radius a at distance rho from the axis.
  template <class Real>
  Real overlap(const Real& rho, const Real& a) const {
    return rho + a - Real(radius);
  }
};

}  // namespace shakebed::simulator
