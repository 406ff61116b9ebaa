#pragma once

#include <vector>

#include "simulator/motion/column/row_store.hpp"

namespace shakebed::simulator {

/// Rows that are left to fly: not moved step by step, but carried along their parabola when they
/// are asked for: what k leapfrog steps under gravity come to.
class FreeRows {
 public:
  FreeRows(std::size_t rows, double time_step, double gravity, double prediction)
      : since_(rows, -1), time_step_(time_step), gravity_(gravity), prediction_(prediction) {}

  void leave(std::uint32_t i, long step) { since_[i] = step; }
  bool flies(std::uint32_t i) const { return since_[i] >= 0; }

  /// Where row i is at `step`.
  Four place(const RowStore& rows, std::uint32_t i, long step) const {
    Four place = rows.position[i];
    if (!flies(i)) return place;
    const auto n = static_cast<double>(step - since_[i]);
    place += (n * time_step_) * three_of(rows.own[i].half_velocity);
    place[2] += 0.5 * n * (n + 1) * time_step_ * fall();
    return place;
  }

  /// Its velocities half a step before.
  OwnRow look(const RowStore& rows, std::uint32_t i, long step) const {
    OwnRow own = rows.own[i];
    if (flies(i)) own.half_velocity[2] += static_cast<double>(step - since_[i]) * fall();
    return own;
  }

  void land(RowStore& rows, std::uint32_t i, long step) {
    if (!flies(i)) return;
    rows.position[i] = place(rows, i, step);
    rows.own[i] = look(rows, i, step);
    rows.motion[i].velocity = three_of(rows.own[i].half_velocity);
    rows.motion[i].velocity[2] += prediction_ * -gravity_;
    since_[i] = -1;
  }

  template <class Archive>
  void archive(Archive& a) {
    a(since_);
  }

 private:
  /// What gravity adds to a velocity in a step.
  double fall() const { return -gravity_ * time_step_; }

  std::vector<long> since_;  ///< the step at which a row was left, or -1
  double time_step_;
  double gravity_;
  double prediction_;
};

}  // namespace shakebed::simulator
