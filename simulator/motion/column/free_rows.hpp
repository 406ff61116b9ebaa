#pragma once

#include <vector>

#include "simulator/motion/column/row_store.hpp"

namespace shakebed::simulator {

/// Rows that are left to fly: not moved step by step, but carried along their parabola when they
/// are asked for.
class FreeRows {
 public:
  FreeRows(std::size_t rows, double time_step, double gravity, double prediction)
      : since_(rows, -1), time_step_(time_step), gravity_(gravity), prediction_(prediction) {}

  void leave(std::uint32_t i, long step) { since_[i] = step; }
  bool flies(std::uint32_t i) const { return since_[i] >= 0; }

  /// Row i as it is at `step`.
  void look(const RowStore& rows, std::uint32_t i, long step, SeenRow& seen, OwnRow& own) const {
    seen = rows.seen[i];
    own = rows.own[i];
    if (flies(i)) fly(seen, own, step - since_[i]);
  }

  void land(RowStore& rows, std::uint32_t i, long step) {
    if (!flies(i)) return;
    fly(rows.seen[i], rows.own[i], step - since_[i]);
    since_[i] = -1;
  }

  template <class Archive>
  void archive(Archive& a) {
    a(since_);
  }

 private:
  /// What k leapfrog steps under gravity come to.
  void fly(SeenRow& seen, OwnRow& own, long k) const {
    const auto n = static_cast<double>(k);
    const double dt = time_step_;
    const double fall = -gravity_ * dt;
    const Four v = three_of(own.half_velocity);
    seen.position += (n * dt) * v;
    seen.position[2] += 0.5 * n * (n + 1) * dt * fall;
    own.half_velocity[2] += n * fall;
    seen.velocity = three_of(own.half_velocity);
    seen.velocity[2] += prediction_ * -gravity_;
  }

  std::vector<long> since_;  ///< the step at which a row was left, or -1
  double time_step_;
  double gravity_;
  double prediction_;
};

}  // namespace shakebed::simulator
