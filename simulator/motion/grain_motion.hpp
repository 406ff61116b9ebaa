#pragma once

#include "simulator/dimension.hpp"

namespace shakebed::simulator {

/// A grain's centre, velocity and spin at one instant.
template <class Physics>
struct GrainMotion {
  Vector<Physics::dimension> x;
  Vector<Physics::dimension> v;
  Eigen::Matrix<double, Physics::GrainState::spin_columns, 1> spin;

  /// Where it was, or will be, tau later in free flight under gravity g.
  GrainMotion flown(double tau, double gravity) const {
    constexpr int vertical = Dimension<Physics::dimension>::vertical;
    GrainMotion then = *this;
    then.x += tau * v;
    then.x[vertical] -= 0.5 * gravity * tau * tau;
    then.v[vertical] -= gravity * tau;
    return then;
  }
};

}  // namespace shakebed::simulator
