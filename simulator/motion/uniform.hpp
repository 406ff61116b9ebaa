#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulator/motion/leapfrog.hpp"
#include "simulator/motion/neighbours.hpp"
#include "simulator/motion/walled_physics.hpp"

namespace shakebed::simulator {

/// Reference engine: every grain at every step, pairs from a Verlet list. Everything faster is
/// checked against it. The one engine that knows walls other than the base.
template <class Physics>
class UniformStepper {
 public:
  static constexpr int D = Physics::dimension;
  static constexpr bool turns_grains = Physics::turns_grains;
  using GrainState = typename Physics::GrainState;
  static constexpr int S = GrainState::spin_columns;

  /// Starts at step 0 of a cycle (the base at its mean height, moving up).
  UniformStepper(const Physics& physics, const GrainState& start)
      : physics_(physics), search_(physics.cell), state_(start) {
    const std::size_t n = start.count();
    grains_.resize_to(n);
    grains_.position = start.position;
    grains_.half_velocity = grains_.predicted_velocity = start.velocity;
    grains_.half_spin = grains_.predicted_spin = start.spin;
    std::fill(grains_.acceleration[vertical].begin(), grains_.acceleration[vertical].end(),
              -physics_.gravity);
    rebuild();
    ++step_stamp_;
    accumulate_contacts();
    ledger_ = {};
    const double h = 0.5 * physics_.time_step;
    for (std::size_t i = 0; i < n; ++i) {
      add_to_row(grains_.half_velocity, i, Vector<D>(-h * row(grains_.acceleration, i)));
      for (int c = 0; c < S; ++c) grains_.half_spin[c][i] -= h * grains_.spin_acceleration[c][i];
    }
  }

  void advance(long steps) {
    for (long s = 0; s < steps; ++s) step();
  }

  /// Positions, velocities and spins at the present step.
  const GrainState& synchronised() {
    const double h = 0.5 * physics_.time_step;
    state_.position = grains_.position;
    for (int c = 0; c < D; ++c) {
      for (std::size_t i = 0; i < grains_.count(); ++i) {
        state_.velocity[c][i] = grains_.half_velocity[c][i] + h * grains_.acceleration[c][i];
      }
    }
    for (int c = 0; c < S; ++c) {
      for (std::size_t i = 0; i < grains_.count(); ++i) {
        state_.spin[c][i] = grains_.half_spin[c][i] + h * grains_.spin_acceleration[c][i];
      }
    }
    return state_;
  }

  /// Multiplies every velocity and spin: an artificial cooling, used only while settling.
  void damp(double factor) {
    for (auto& column : grains_.half_velocity) {
      for (double& v : column) v *= factor;
    }
    for (auto& column : grains_.half_spin) {
      for (double& omega : column) omega *= factor;
    }
  }

  double kinetic_energy() { return mechanical_energy(synchronised(), 0); }

  EnergyLedger& ledger() { return ledger_; }
  long step_in_cycle() const { return step_in_cycle_; }
  const std::vector<NeighbourPair<D>>& neighbour_pairs() const { return pairs_; }
  long list_builds() const { return list_builds_; }

  /// Kinetic, potential and stored elastic energy [m g d].
  double energy() { return mechanical_energy(synchronised(), physics_.gravity) + elastic_energy(); }

  /// Sum of the vertical forces the base puts on grains at the present step [m g].
  double base_force() const { return base_force_; }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  void step() {
    if (--steps_until_list_check_ <= 0) check_list();
    if (++step_in_cycle_ == physics_.steps_per_cycle) step_in_cycle_ = 0;
    ++step_stamp_;
    grains_.kick_drift_predict(physics_);
    accumulate_contacts();
  }

  void accumulate_contacts() {
    if constexpr (Physics::walled) {
      accumulate_walls();
    } else {
      accumulate_base();
    }
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Vector<D> r = separation(pairs_[k]);
      const double r2 = r.squaredNorm();
      if (r2 < 4 * grain_radius * grain_radius) [[unlikely]] {
        const bool begins = pair_touched_[k] != step_stamp_ - 1;
        grains_.touch_pair(physics_, pairs_[k].i, pairs_[k].j, r, r2, begins, ledger_);
        pair_touched_[k] = step_stamp_;
      }
    }
  }

  void accumulate_base() {
    const BaseState base = physics_.base_at_step(step_in_cycle_);
    base_force_ = 0;
    for (const auto i : near_base_) {
      const double overlap = grains_.base_overlap(i, base);
      if (overlap <= 0) continue;
      const bool begins = base_touched_[i] != step_stamp_ - 1;
      base_force_ += grains_.touch_base(physics_, i, base, overlap, begins, ledger_);
      base_touched_[i] = step_stamp_;
    }
  }

  void accumulate_walls() {
    const BaseState base = physics_.base_at_step(step_in_cycle_);
    base_force_ = 0;
    for (std::size_t w = 0; w < physics_.walls.size(); ++w) {
      const auto& wall = physics_.walls[w];
      const auto& coordinate = grains_.position[wall.axis];
      for (const auto i : near_walls_[w]) {
        const double overlap = physics_.overlap(wall, coordinate[i], base);
        if (overlap <= 0) continue;
        long& touched = base_touched_[w * grains_.count() + i];
        const bool begins = touched != step_stamp_ - 1;
        const double force = grains_.touch_wall(physics_, wall, i, base, overlap, begins, ledger_);
        if (w == 0) base_force_ += force;
        touched = step_stamp_;
      }
    }
  }

  double elastic_energy() const {
    const BaseState base = physics_.base_at_step(step_in_cycle_);
    double energy = 0;
    if constexpr (Physics::walled) {
      for (std::size_t w = 0; w < physics_.walls.size(); ++w) {
        const auto& wall = physics_.walls[w];
        for (const auto i : near_walls_[w]) {
          const double overlap = physics_.overlap(wall, grains_.position[wall.axis][i], base);
          if (overlap > 0) energy += wall.law.normal.stored_energy(overlap);
        }
      }
    }
    for (const auto i : near_base_) {
      const double overlap = grains_.base_overlap(i, base);
      if (overlap > 0) energy += physics_.grain_base.normal.stored_energy(overlap);
    }
    for (const auto& pair : pairs_) {
      const double overlap = 2 * grain_radius - separation(pair).norm();
      if (overlap > 0) energy += physics_.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

  Vector<D> separation(const NeighbourPair<D>& pair) const {
    Vector<D> r;
    for (int c = 0; c < D; ++c) {
      r[c] = grains_.position[c][pair.j] - grains_.position[c][pair.i];
      if (c < Dimension<D>::lateral) r[c] += pair.shift[c];
    }
    return r;
  }

  /// Keeps the list while no grain can have moved by half the skin before the next look.
  void check_list() {
    double travelled = std::sqrt(largest_squared(
        [&](int c, std::size_t i) { return grains_.position[c][i] - built_at_[c][i]; }));
    if constexpr (Physics::walled) {
      const double height = physics_.base_at_step(step_in_cycle_).height;
      travelled = std::max(travelled, std::abs(height - base_built_at_));
    }
    const long safe = safe_steps(0.5 * skin_ - travelled);
    if (safe < 8) {
      rebuild();
    } else {
      steps_until_list_check_ = safe;
    }
  }

  long safe_steps(double distance) const {
    const double steps = distance / (speed_bound() * physics_.time_step);
    return std::clamp(static_cast<long>(steps), 1L, 64L);
  }

  /// No grain exceeds this before the next look: two grains may pool their kinetic energy, the
  /// base may add twice its speed, and the factor beyond sqrt(2) allows for spin.
  double speed_bound() const {
    return 1e-12 + 2 * physics_.base.peak_velocity +
           2 * std::sqrt(largest_squared(
                   [&](int c, std::size_t i) { return grains_.half_velocity[c][i]; }));
  }

  template <class Component>
  double largest_squared(Component component) const {
    double largest = 0;
    for (std::size_t i = 0; i < grains_.count(); ++i) {
      double square = 0;
      for (int c = 0; c < D; ++c) square += component(c, i) * component(c, i);
      largest = std::max(largest, square);
    }
    return largest;
  }

  /// A skin that lasts about 160 steps at present speeds (half of speed_bound): longer lists cost
  /// every step, more frequent builds cost a search each.
  void rebuild() {
    ++list_builds_;
    const double widest = 0.5 * physics_.cell.narrowest() - 2 * grain_radius;
    skin_ = std::clamp(2 * 80 * speed_bound() * physics_.time_step, std::min(0.1, widest),
                       std::min(1.0, widest));
    std::vector<NeighbourPair<D>> touching_before;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (pair_touched_[k] == step_stamp_) touching_before.push_back(pairs_[k]);
    }
    search_.find(grains_.position, 2 * grain_radius + skin_, pairs_);
    pair_touched_.assign(pairs_.size(), -1);
    mark_touching(touching_before);
    built_at_ = grains_.position;
    if constexpr (Physics::walled) {
      list_grains_near_walls();
    } else {
      list_grains_near_base();
    }
    steps_until_list_check_ = safe_steps(0.5 * skin_);
  }

  void list_grains_near_base() {
    near_base_.clear();
    for (std::uint32_t i = 0; i < grains_.count(); ++i) {
      if (grains_.position[vertical][i] < physics_.base.amplitude + grain_radius + 0.5 * skin_) {
        near_base_.push_back(i);
      }
    }
    base_touched_.resize(grains_.count(), -1);
  }

  /// Until the next build a grain and a moving wall travel at most half the skin each.
  void list_grains_near_walls() {
    const BaseState base = physics_.base_at_step(step_in_cycle_);
    base_built_at_ = base.height;
    near_walls_.resize(physics_.walls.size());
    base_touched_.resize(physics_.walls.size() * grains_.count(), -1);
    for (std::size_t w = 0; w < physics_.walls.size(); ++w) {
      const auto& wall = physics_.walls[w];
      near_walls_[w].clear();
      for (std::uint32_t i = 0; i < grains_.count(); ++i) {
        const double overlap = physics_.overlap(wall, grains_.position[wall.axis][i], base);
        if (overlap > -skin_) near_walls_[w].push_back(i);
      }
    }
  }

  /// Pairs by grain numbers, whichever of the two comes first.
  static std::uint64_t name_of(const NeighbourPair<D>& pair) {
    const auto [first, second] = std::minmax(pair.i, pair.j);
    return (static_cast<std::uint64_t>(first) << 32) | second;
  }

  void mark_touching(const std::vector<NeighbourPair<D>>& before) {
    if (before.empty()) return;
    std::vector<std::uint64_t> touching;
    for (const auto& pair : before) touching.push_back(name_of(pair));
    std::sort(touching.begin(), touching.end());
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (std::binary_search(touching.begin(), touching.end(), name_of(pairs_[k]))) {
        pair_touched_[k] = step_stamp_;
      }
    }
  }

  Physics physics_;
  LeapfrogGrains<Physics> grains_;
  EnergyLedger ledger_;
  double base_force_ = 0;

  NeighbourSearch<D> search_;
  std::vector<NeighbourPair<D>> pairs_;
  std::vector<long> pair_touched_;  ///< the last step at which the pair touched
  std::vector<long> base_touched_;  ///< by grain; of a walled bed by wall and grain
  std::vector<std::uint32_t> near_base_;
  std::vector<std::vector<std::uint32_t>> near_walls_;  ///< of a walled bed, in place of near_base_
  double base_built_at_ = 0;
  GrainState state_;
  Columns<D> built_at_;
  double skin_ = 0;
  long list_builds_ = 0;
  long step_stamp_ = 0;
  long step_in_cycle_ = 0;
  long steps_until_list_check_ = 1;
};

}  // namespace shakebed::simulator
