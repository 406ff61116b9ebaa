#pragma once

#include <utility>
#include <vector>

#include "simulator/motion/contact_batch.hpp"
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
               const std::vector<PairOfGrains>& touching, const std::vector<std::uint32_t>& on_base)
      : physics_(physics), lists_(physics, std::move(rows), step, touching), step_(step) {
    base_touched_.assign(lists_.rows.size(), -1);
    for (const auto i : on_base) base_touched_[i] = step;
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

  bool on_base(std::size_t i) const { return base_touched_[i] == step_; }
  std::vector<PairOfGrains> touching_pairs() const { return lists_.touching_pairs(); }

  double elastic_energy() {
    const BaseState base = base_now();
    double energy = 0;
    for (const Row& row : rows()) {
      const double overlap = row.base_overlap(base);
      if (overlap > 0) energy += physics_.grain_base.normal.stored_energy(overlap);
    }
    for (const auto& pair : lists_.outer()) {
      const double overlap = 2 * grain_radius - lists_.separation_of(pair).norm();
      if (overlap > 0) energy += physics_.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

 private:
  BaseState base_now() const { return physics_.base_at_step(step_ % physics_.steps_per_cycle); }

  void accumulate_contacts(EnergyLedger& ledger) {
    touching_ = touch_base(ledger);
    for (std::size_t n = 0; n < lists_.candidates.size();) {
      const auto& listed = lists_.candidates[n];
      const auto r = lists_.separation_of(listed.pair);
      if (r.squaredNorm() < 4 * grain_radius * grain_radius) [[unlikely]] {
        ++ledger.collisions;
        lists_.begin_contact(n);
      } else {
        ++n;
      }
    }
    touch_pairs(ledger);
    touching_ += static_cast<long>(lists_.touching.size());
  }

  long touch_base(EnergyLedger& ledger) {
    if (lists_.near_base.empty()) return 0;
    const BaseState base = base_now();
    long count = 0;
    auto& rows = lists_.rows;
    for (const auto i : lists_.near_base) {
      const double overlap = rows[i].base_overlap(base);
      if (overlap <= 0) continue;
      if (base_touched_[i] != step_ - 1) ++ledger.collisions;
      base_touched_[i] = step_;
      ++count;
      batch_.add_base(rows.data(), i, base, overlap);
      if (batch_.full()) batch_.apply_base(physics_, base, rows.data(), ledger);
    }
    batch_.apply_base(physics_, base, rows.data(), ledger);
    return count;
  }

  void touch_pairs(EnergyLedger& ledger) {
    ended_.clear();
    std::size_t first = 0;
    const auto apply = [&] {
      batch_.apply_pairs(physics_, lists_.rows.data(), ledger,
                         [&](std::size_t k) { ended_.push_back(first + k); });
    };
    for (std::size_t n = 0; n < lists_.touching.size(); ++n) {
      const auto& pair = lists_.touching[n].pair;
      batch_.add_pair(lists_.rows.data(), pair.i, pair.j, pair.shift);
      if (!batch_.full()) continue;
      apply();
      first = n + 1;
    }
    apply();
    for (auto n = ended_.rbegin(); n != ended_.rend(); ++n) lists_.end_contact(*n);
  }

  Physics physics_;
  DenseLists<Physics> lists_;
  long step_;
  long touching_ = 0;
  std::vector<std::size_t> ended_;
  std::vector<std::uint32_t> broke_promise_;
  std::vector<long> base_touched_;
  ContactBatch<Physics> batch_;
};

}  // namespace shakebed::simulator
