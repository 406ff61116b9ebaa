#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/lanes.hpp"

namespace shakebed::simulator {

/// One next event per grain: its time, and the earliest over all grains. Times lie in blocks of
/// lanes, with the earliest of each block kept, so that finding and changing cost two short scans
/// for any bed that fits a machine.
class Calendar {
 public:
  explicit Calendar(std::size_t count)
      : block_(count <= 256 ? 16 : 64),
        times_((count + block_ - 1) / block_ * block_, forever()),
        earliest_((times_.size() / block_ + lane_count - 1) / lane_count * lane_count, forever()) {}

  double time(std::size_t i) const { return times_[i]; }

  void set(std::size_t i, double time) {
    times_[i] = time;
    const std::size_t b = i / block_;
    earliest_[b] = least(&times_[b * block_], block_);
    known_ = false;
  }

  struct Entry {
    std::uint32_t grain;
    double time;
  };

  Entry earliest() {
    if (!known_) earliest_entry_ = find_earliest();
    known_ = true;
    return earliest_entry_;
  }

  /// What was time T is time 0.
  void rebase(double T) {
    for (double& t : times_) t -= T;
    for (double& t : earliest_) t -= T;
    known_ = false;
  }

 private:
  static constexpr double forever() { return std::numeric_limits<double>::infinity(); }

  Entry find_earliest() const {
    const double time = least(earliest_.data(), earliest_.size());
    const std::size_t first = place_of(time, earliest_.data()) * block_;
    return {static_cast<std::uint32_t>(first + place_of(time, &times_[first])), time};
  }

  /// Where `value`, which is there, stands first.
  static std::size_t place_of(double value, const double* values) {
    for (std::size_t k = 0;; k += lane_count) {
      const auto equal = load_lanes(values + k) == value;
      if (std::experimental::any_of(equal)) {
        return k + static_cast<std::size_t>(std::experimental::find_first_set(equal));
      }
    }
  }

  static double least(const double* values, std::size_t count) {
    Lanes best = forever();
    for (std::size_t k = 0; k < count; k += lane_count) {
      best = std::experimental::min(best, load_lanes(values + k));
    }
    return std::experimental::hmin(best);
  }

  std::size_t block_;
  std::vector<double> times_;
  std::vector<double> earliest_;
  Entry earliest_entry_{};  ///< kept while grains on the grid are stepped and no event changes
  bool known_ = false;
};

}  // namespace shakebed::simulator
