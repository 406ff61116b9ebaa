#pragma once

#include <algorithm>
#include <ranges>
#include <utility>
#include <vector>

#include "simulator/motion/dense_contacts.hpp"
#include "simulator/motion/dense_lists.hpp"

namespace shakebed::simulator {

/// All grains on the time grid, for when many of them touch. Like the uniform engine, but only the
/// pairs that may meet within a window of steps are looked at, touching ones in batches, and grains
/// that nothing can touch within it are carried over it at once.
template <class Physics>
class DenseStepper {
 public:
  static constexpr int D = Physics::dimension;
  using Row = GridRow<Physics>;
  using PairOfGrains = typename DenseLists<Physics>::PairOfGrains;

  /// Takes over the grains at `step` of the run; `touching` and `on_base` name the contacts of that
  /// step, which go on and do not begin again.
  DenseStepper(const Physics& physics, std::vector<Row> rows, long step,
               const std::vector<PairOfGrains>& touching, const std::vector<std::uint32_t>& on_base,
               long window_steps = 32)
      : physics_(physics),
        lists_(physics, std::move(rows), step, touching, window_steps),
        step_(step) {
    wall_touched_.assign(lists_.near_walls.size() * lists_.rows.size(), -1);
    for (const auto i : on_base) wall_touched_[i] = step;
  }

  /// Grains at the beginning of a run, for begin().
  static std::vector<Row> rows_of(const Physics& physics,
                                  const typename Physics::GrainState& start) {
    std::vector<Row> rows(start.count());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].set_flying(row(start.position, i), row(start.velocity, i), row(start.spin, i),
                         physics);
      rows[i].half[vertical] = start.velocity[vertical][i];
    }
    return rows;
  }

  /// Computes the contacts of the present step from full velocities, as a run begins.
  void begin(EnergyLedger& ledger) {
    for (Row& row : lists_.rows) row.predicted = row.half;
    accumulate_contacts(ledger);
    const double h = 0.5 * physics_.time_step;
    for (Row& row : lists_.rows) {
      for (std::size_t c = 0; c < Row::width; ++c) row.half[c] -= h * row.change[c];
    }
    lists_.open_next_window(step_);
  }

  void step(EnergyLedger& ledger) {
    if (lists_.window_over(step_)) lists_.open_next_window(step_);
    ++step_;
    lists_.note_fall();
    broke_promise_.clear();
    for (const auto i : lists_.stepped) {
      lists_.rows[i].kick_drift_predict(physics_.time_step, physics_.gravity);
      if (lists_.breaks_promise(i)) [[unlikely]]
        broke_promise_.push_back(i);
    }
    for (const auto i : broke_promise_) lists_.look_again(i, step_);
    accumulate_contacts(ledger);
  }

  long touching() const { return touching_; }
  const std::vector<Row>& rows() {
    lists_.catch_up(step_);
    return lists_.rows;
  }

  bool on_base(std::size_t i) const { return wall_touched_[i] == step_; }
  std::vector<PairOfGrains> touching_pairs() const { return lists_.touching_pairs(); }

  double elastic_energy() {
    const BaseState base = base_now();
    double energy = 0;
    for (const Row& row : rows()) energy += elastic_energy_at_walls(row, base);
    for (const auto& pair : lists_.outer()) {
      const double overlap = 2 * grain_radius - lists_.separation_of(pair).norm();
      if (overlap > 0) energy += physics_.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  BaseState base_now() const { return physics_.base_at_step(step_ % physics_.steps_per_cycle); }

  void accumulate_contacts(EnergyLedger& ledger) {
    if constexpr (Physics::walled) {
      touching_ = touch_walls(ledger);
    } else {
      touching_ = touch_base(ledger);
    }
    find_begun(lists_.candidates, lists_.rows.data(), found_);
    ledger.collisions += static_cast<long>(found_.size());
    for (const auto n : std::views::reverse(found_)) lists_.begin_contact(n);
    touch_pairs(physics_, lists_.touching, lists_.rows.data(), ledger, found_);
    for (const auto n : std::views::reverse(found_)) lists_.end_contact(n);
    touching_ += static_cast<long>(lists_.touching.size());
  }

  long touch_base(EnergyLedger& ledger) {
    if (lists_.near_walls[0].empty()) return 0;
    const BaseState base = base_now();
    base_hits_.clear();
    for (const auto i : lists_.near_walls[0]) {
      const double overlap = lists_.rows[i].base_overlap(base);
      if (overlap <= 0) continue;
      if (wall_touched_[i] != step_ - 1) ++ledger.collisions;
      wall_touched_[i] = step_;
      base_hits_.push_back({i, overlap});
    }
    simulator::touch_base(physics_, base, base_hits_, lists_.rows.data(), ledger);
    return static_cast<long>(base_hits_.size());
  }

  long touch_walls(EnergyLedger& ledger) {
    if (std::ranges::all_of(lists_.near_walls, [](const auto& near) { return near.empty(); })) {
      return 0;
    }
    const BaseState base = base_now();
    long count = 0;
    for (std::size_t w = 0; w < physics_.walls.size(); ++w) {
      const auto& wall = physics_.walls[w];
      Vector<D> n = Vector<D>::Zero();
      n[wall.axis] = -wall.inward;
      for (const auto i : lists_.near_walls[w]) {
        Row& row = lists_.rows[i];
        const double overlap = physics_.overlap(wall, row.x[wall.axis], base);
        if (overlap <= 0) continue;
        long& touched = wall_touched_[w * lists_.rows.size() + i];
        touch_plane(physics_, wall.law, row, n, wall.drive_axis, wall.moves ? base.velocity : 0,
                    overlap, touched != step_ - 1, ledger);
        touched = step_;
        ++count;
      }
    }
    return count;
  }

  double elastic_energy_at_walls(const Row& row, const BaseState& base) const {
    double energy = 0;
    const auto add = [&](const auto& law, double overlap) {
      if (overlap > 0) energy += law.normal.stored_energy(overlap);
    };
    if constexpr (Physics::walled) {
      for (const auto& wall : physics_.walls) {
        add(wall.law, physics_.overlap(wall, row.x[wall.axis], base));
      }
    } else {
      add(physics_.grain_base, row.base_overlap(base));
    }
    return energy;
  }

  Physics physics_;
  DenseLists<Physics> lists_;
  long step_;
  long touching_ = 0;
  std::vector<std::uint32_t> found_;  ///< pairs that begin or end to touch
  std::vector<BaseHit> base_hits_;
  std::vector<std::uint32_t> broke_promise_;
  std::vector<long> wall_touched_;  ///< by wall and row: the last step of a contact
};

}  // namespace shakebed::simulator
