#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "simulator/motion/leapfrog.hpp"
#include "simulator/motion/neighbours.hpp"

namespace shakebed::simulator {

/// All grains on the time grid, for when most of them touch. Like the uniform engine, with a
/// second, inner list: only pairs that can touch within the next few steps, given a cap on every
/// grain's speed, are looked at. A grain that breaks its cap has the inner list made again at once.
template <class Physics>
class DenseStepper {
 public:
  static constexpr int D = Physics::dimension;
  using PairOfGrains = std::pair<std::uint32_t, std::uint32_t>;

  /// Takes over `grains` at `step` of the run; `touching` and `on_base` name the contacts of that
  /// step, which go on and do not begin again.
  DenseStepper(const Physics& physics, LeapfrogGrains<Physics> grains, long step,
               const std::vector<PairOfGrains>& touching, const std::vector<std::uint32_t>& on_base)
      : physics_(physics), grains_(std::move(grains)), search_(physics.cell), step_(step) {
    base_touched_.assign(grains_.count(), -1);
    for (const auto i : on_base) base_touched_[i] = step;
    rebuild_outer();
    for (const auto& [i, j] : touching) mark_touching(i, j);
    rebuild_inner();
  }

  /// Computes the contacts of the present step from full velocities, as a run begins.
  void begin(EnergyLedger& ledger) {
    grains_.predicted_velocity = grains_.half_velocity;
    grains_.predicted_spin = grains_.half_spin;
    accumulate_contacts(ledger);
    const double h = 0.5 * physics_.time_step;
    for (std::size_t i = 0; i < grains_.count(); ++i) {
      Vector<D> a = row(grains_.acceleration, i);
      set_row(grains_.half_velocity, i, Vector<D>(row(grains_.half_velocity, i) - h * a));
      for (std::size_t c = 0; c < grains_.half_spin.size(); ++c) {
        grains_.half_spin[c][i] -= h * grains_.spin_acceleration[c][i];
      }
    }
  }

  void step(EnergyLedger& ledger) {
    if (step_ >= inner_valid_until_ || cap_broken()) refresh_lists();
    ++step_;
    grains_.kick_drift_predict(physics_);
    accumulate_contacts(ledger);
  }

  long step_number() const { return step_; }
  long touching() const { return touching_; }
  const LeapfrogGrains<Physics>& grains() const { return grains_; }

  bool on_base(std::size_t i) const { return base_touched_[i] == step_; }
  std::vector<PairOfGrains> touching_pairs() const {
    std::vector<PairOfGrains> pairs;
    for (std::size_t k = 0; k < outer_.size(); ++k) {
      if (touched_[k] == step_) pairs.emplace_back(outer_[k].i, outer_[k].j);
    }
    return pairs;
  }

  double elastic_energy() const {
    const BaseState base = physics_.base_at_step(step_ % physics_.steps_per_cycle);
    double energy = 0;
    for (std::size_t i = 0; i < grains_.count(); ++i) {
      const double overlap = grains_.base_overlap(i, base);
      if (overlap > 0) energy += physics_.grain_base.normal.stored_energy(overlap);
    }
    for (const auto& pair : outer_) {
      const double overlap = 2 * grain_radius - separation(pair).norm();
      if (overlap > 0) energy += physics_.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;
  static constexpr long inner_window = 24;

  void accumulate_contacts(EnergyLedger& ledger) {
    touching_ = 0;
    const BaseState base = physics_.base_at_step(step_ % physics_.steps_per_cycle);
    for (const auto i : near_base_) {
      const double overlap = grains_.base_overlap(i, base);
      if (overlap <= 0) continue;
      grains_.touch_base(physics_, i, base, overlap, base_touched_[i] != step_ - 1, ledger);
      base_touched_[i] = step_;
      ++touching_;
    }
    for (std::size_t n = 0; n < touching_pairs_.size();) {
      if (touch_if_near(touching_pairs_[n], ledger)) [[likely]] {
        ++n;
      } else {
        move_pair(touching_pairs_, n, candidates_);
      }
    }
    touching_ += static_cast<long>(touching_pairs_.size());
    for (std::size_t n = 0; n < candidates_.size();) {
      if (touch_if_near(candidates_[n], ledger)) [[unlikely]] {
        move_pair(candidates_, n, touching_pairs_);
        ++touching_;
      } else {
        ++n;
      }
    }
  }

  /// A pair of the inner list, with its own copy of what the outer list knows.
  struct InnerPair {
    NeighbourPair<D> pair;
    std::uint32_t k;  ///< in outer_
  };

  bool touch_if_near(const InnerPair& inner, EnergyLedger& ledger) {
    const Vector<D> r = separation(inner.pair);
    const double rr = r.squaredNorm();
    if (rr >= 4 * grain_radius * grain_radius) return false;
    long& touched = touched_[inner.k];
    grains_.touch_pair(physics_, inner.pair.i, inner.pair.j, r, rr, touched != step_ - 1, ledger);
    touched = step_;
    return true;
  }

  static void move_pair(std::vector<InnerPair>& from, std::size_t n, std::vector<InnerPair>& to) {
    to.push_back(from[n]);
    from[n] = from.back();
    from.pop_back();
  }

  Vector<D> separation(const NeighbourPair<D>& pair) const {
    Vector<D> r;
    for (int c = 0; c < D; ++c) {
      r[c] = grains_.position[c][pair.j] - grains_.position[c][pair.i];
      if (c < Dimension<D>::lateral) r[c] += pair.shift[c];
    }
    return r;
  }

  bool cap_broken() const {
    double worst = -1;
    for (std::size_t i = 0; i < grains_.count(); ++i) {
      double square = 0;
      for (int c = 0; c < D; ++c)
        square += grains_.half_velocity[c][i] * grains_.half_velocity[c][i];
      worst = std::max(worst, square - cap_squared_[i]);
    }
    return worst > 0;
  }

  void refresh_lists() {
    double travelled = 0;
    double fastest = 0;
    for (std::size_t i = 0; i < grains_.count(); ++i) {
      travelled = std::max(travelled, (row(grains_.position, i) - row(built_at_, i)).norm());
      fastest = std::max(fastest, speed_cap(i));
    }
    const double window = (inner_window + 1) * physics_.time_step;
    if (travelled + fastest * window > 0.5 * skin_) rebuild_outer();
    rebuild_inner();
  }

  /// What a grain may reach within the inner window; beyond it the list is made again.
  double speed_cap(std::size_t i) const {
    return 1.25 * row(grains_.half_velocity, i).norm() + 0.5 * physics_.base.peak_velocity;
  }

  void rebuild_outer() {
    double fastest = 0;
    for (std::size_t i = 0; i < grains_.count(); ++i) fastest = std::max(fastest, speed_cap(i));
    const double widest = 0.5 * physics_.cell.narrowest() - 2 * grain_radius;
    constexpr double lasting = 8 * inner_window;
    skin_ = std::clamp(2 * lasting * fastest * physics_.time_step, std::min(0.1, widest),
                       std::min(1.0, widest));
    const auto before = touching_pairs();
    search_.find(grains_.position, 2 * grain_radius + skin_, outer_);
    touched_.assign(outer_.size(), -1);
    for (const auto& [i, j] : before) mark_touching(i, j);
    built_at_ = grains_.position;
  }

  void rebuild_inner() {
    const double window = (inner_window + 1) * physics_.time_step;
    caps_.resize(grains_.count());
    cap_squared_.resize(grains_.count());
    near_base_.clear();
    for (std::uint32_t i = 0; i < grains_.count(); ++i) {
      caps_[i] = speed_cap(i);
      cap_squared_[i] = caps_[i] * caps_[i];
      const double gap = grains_.position[vertical][i] - grain_radius - physics_.base.amplitude;
      if (gap < caps_[i] * window) near_base_.push_back(i);
    }
    touching_pairs_.clear();
    candidates_.clear();
    for (std::uint32_t k = 0; k < outer_.size(); ++k) {
      const double reach =
          2 * grain_radius + 1.05 * window * (caps_[outer_[k].i] + caps_[outer_[k].j]);
      if (separation(outer_[k]).squaredNorm() >= reach * reach) continue;
      (touched_[k] == step_ ? touching_pairs_ : candidates_).push_back({outer_[k], k});
    }
    inner_valid_until_ = step_ + inner_window;
  }

  void mark_touching(std::uint32_t i, std::uint32_t j) {
    for (std::size_t k = 0; k < outer_.size(); ++k) {
      const auto& pair = outer_[k];
      if ((pair.i == i && pair.j == j) || (pair.i == j && pair.j == i)) touched_[k] = step_;
    }
  }

  Physics physics_;
  LeapfrogGrains<Physics> grains_;
  NeighbourSearch<D> search_;
  long step_;
  long touching_ = 0;
  std::vector<NeighbourPair<D>> outer_;
  std::vector<long> touched_;  ///< the last step at which the outer pair touched
  // Whether a pair touches cannot be predicted in one mixed list, and a wrong guess costs as much
  // as the force; a contact lasts some fifty steps, so that in lists kept apart it can.
  std::vector<InnerPair> touching_pairs_;
  std::vector<InnerPair> candidates_;
  std::vector<std::uint32_t> near_base_;
  std::vector<long> base_touched_;
  std::vector<double> caps_;
  std::vector<double> cap_squared_;
  Columns<D> built_at_;
  double skin_ = 0;
  long inner_valid_until_ = 0;
};

}  // namespace shakebed::simulator
