#pragma once

#include <algorithm>
#include <limits>

#include "simulator/motion/column/promise.hpp"
#include "simulator/motion/column/rows.hpp"

namespace shakebed::simulator {

/// From the least to the largest of some numbers.
struct Spread {
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();

  void take(double x) {
    least = std::min(least, x);
    largest = std::max(largest, x);
  }
  void take(const Spread& other) {
    least = std::min(least, other.least);
    largest = std::max(largest, other.largest);
  }
  double middle() const { return 0.5 * (least + largest); }
};

/// The frame in which an outer list is judged: what rows go in common brings no two of them
/// together. Any frame that moves along z does; in this one the fastest row goes no farther than
/// the slowest. Where a shock runs through the bed most grains move with the base and some fall
/// towards them: in the mean's frame these would be by far the fastest.
struct ListFrame {
  double velocity = 0;  ///< within the present window
  double drift = 0;     ///< since the list was built, at the window's beginning

  double speed_of(Four half_velocity) const {
    half_velocity[2] -= velocity;
    return length(half_velocity);
  }
  /// How far a row has come that was at `from` when the list was built and is at `to`, `time` after
  /// the window's beginning.
  double way(const Four& from, const Four& to, double time) const {
    Four moved = to - from;
    moved[2] -= drift + time * velocity;
    return length(moved);
  }

  template <class Archive>
  void archive(Archive& a) {
    a(velocity);
    a(drift);
  }
};

}  // namespace shakebed::simulator
