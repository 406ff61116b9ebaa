#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "simulator/dimension.hpp"

namespace shakebed::simulator {

/// One grain of a contact that wants to be taken in one stride: where it is at touch, and by how
/// much its velocity will change (normal and tangential part), gravity apart.
template <int D>
struct IsolatedGrain {
  std::uint32_t id;
  Vector<D> x;
  Vector<D> v;
  Vector<D> normal_change;
  Vector<D> tangential_change;
  double slack;  ///< how far its path may leave what the changes allow: the line of centres turns

  /// How far its path can stray from the flight it began with, or from the one it ends with.
  double stray(double duration) const {
    return 1.2 * (normal_change.norm() + tangential_change.norm()) * duration + slack;
  }
  double speed_bound() const {
    return v.norm() + 1.2 * (normal_change.norm() + tangential_change.norm());
  }
};

/// Least gap that can open between grain m and a third body during the contact: the third body is
/// `r` from m (nearest image) with relative velocity u = v_k - v_m at touch, and its own path may
/// stray by `stray`. Along the line of centres m's velocity is its first one plus a share between
/// 0 and `overshoot` of its change, so that the gap cannot fall below
///   |r| - 1 - stray + duration min(0, u.d - overshoot (max(0, dv_n.d) + max(0, dv_t.d))),
/// d = r/|r|. (Sideways motion only widens a gap.)
template <int D>
double least_gap(const IsolatedGrain<D>& m, const Vector<D>& r, const Vector<D>& u, double duration,
                 double overshoot, double stray) {
  const double distance = r.norm();
  const Vector<D> d = r / distance;
  const double pushed =
      std::max(0.0, m.normal_change.dot(d)) + std::max(0.0, m.tangential_change.dot(d));
  return distance - 1 - stray + duration * std::min(0.0, u.dot(d) - overshoot * pushed);
}

}  // namespace shakebed::simulator
