#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "bench/baseline/leapfrog.hpp"

// Frozen on 2026-11-22, see bench/baseline/contact.hpp.
namespace shakebed::baseline {

using simulator::mechanical_energy;

/// A pair of grains within reach, through one periodic image: x_j - x_i + shift is the separation
/// until the list is built again.
template <int D>
struct NeighbourPair {
  std::uint32_t i;
  std::uint32_t j;
  std::array<double, Dimension<D>::lateral> shift;
};

/// All pairs closer than `reach`, by nearest image (reach <= half the narrowest width, so that no
/// pair has two images in reach). Grains are swept in order of height: a bed in a narrow cell is
/// a column, and only those within `reach` in height are looked at; wide cells are cut into
/// lateral strips first.
template <int D>
class NeighbourSearch {
 public:
  explicit NeighbourSearch(const PeriodicCell<D>& cell) : cell_(cell) {}

  void find(const Columns<D>& position, double reach, std::vector<NeighbourPair<D>>& pairs) {
    pairs.clear();
    sort_into_strips(position, reach);
    for (std::size_t s = 0; s + 1 < strip_begin_.size(); ++s) {
      for (const std::size_t t : neighbour_strips(s)) {
        if (t == s) {
          sweep(position, reach, s, s, pairs);
        } else if (s < t) {
          sweep(position, reach, s, t, pairs);
        }
      }
    }
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  std::size_t strip_of(const Columns<D>& position, std::size_t i) const {
    std::size_t strip = 0;
    for (int c = 0; c < Dimension<D>::lateral; ++c) {
      const double x = cell_.wrapped(c, position[c][i]) / cell_.width[c];
      const auto n = strips_[c];
      strip = strip * n + std::min(n - 1, static_cast<std::size_t>(x * static_cast<double>(n)));
    }
    return strip;
  }

  void sort_into_strips(const Columns<D>& position, double reach) {
    std::size_t total = 1;
    for (int c = 0; c < Dimension<D>::lateral; ++c) {
      const auto n = static_cast<std::size_t>(cell_.width[c] / reach);
      strips_[c] = n < 4 ? 1 : n;  // with three strips every strip neighbours every other
      total *= strips_[c];
    }
    const std::size_t count = position[0].size();
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    strip_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      strip_[i] = static_cast<std::uint32_t>(strip_of(position, i));
    }
    const auto& z = position[vertical];
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (strip_[a] != strip_[b]) return strip_[a] < strip_[b];
      return z[a] != z[b] ? z[a] < z[b] : a < b;
    });
    strip_begin_.assign(total + 1, 0);
    for (const auto s : strip_) ++strip_begin_[s + 1];
    std::partial_sum(strip_begin_.begin(), strip_begin_.end(), strip_begin_.begin());
  }

  /// This strip and those around it, each once.
  std::vector<std::size_t> neighbour_strips(std::size_t strip) const {
    std::vector<std::size_t> found{0};
    std::size_t divisor = 1;
    for (int c = 0; c < Dimension<D>::lateral; ++c) divisor *= strips_[c];
    std::size_t rest = strip;
    for (int c = 0; c < Dimension<D>::lateral; ++c) {
      const auto n = strips_[c];
      divisor /= n;
      const std::size_t index = rest / divisor;
      rest %= divisor;
      std::vector<std::size_t> next;
      for (const auto prefix : found) {
        if (n == 1) {
          next.push_back(prefix);
        } else {
          for (const std::size_t step : {n - 1, std::size_t{0}, std::size_t{1}}) {
            next.push_back(prefix * n + (index + step) % n);
          }
        }
      }
      found = std::move(next);
    }
    return found;
  }

  void sweep(const Columns<D>& position, double reach, std::size_t s, std::size_t t,
             std::vector<NeighbourPair<D>>& pairs) const {
    const auto& z = position[vertical];
    std::size_t first = strip_begin_[t];
    for (std::size_t a = strip_begin_[s]; a < strip_begin_[s + 1]; ++a) {
      const auto i = order_[a];
      std::size_t b = s == t ? a + 1 : first;
      if (s != t) {
        while (b < strip_begin_[t + 1] && z[order_[b]] < z[i] - reach) ++b;
        first = b;
      }
      for (; b < strip_begin_[t + 1] && z[order_[b]] <= z[i] + reach; ++b) {
        keep_if_near(position, reach, i, order_[b], pairs);
      }
    }
  }

  void keep_if_near(const Columns<D>& position, double reach, std::uint32_t i, std::uint32_t j,
                    std::vector<NeighbourPair<D>>& pairs) const {
    NeighbourPair<D> pair{i, j, {}};
    const double dz = position[vertical][j] - position[vertical][i];
    double r2 = dz * dz;
    for (int c = 0; c < Dimension<D>::lateral; ++c) {
      const double difference = position[c][j] - position[c][i];
      pair.shift[c] = cell_.image_shift(c, difference);
      const double dx = difference + pair.shift[c];
      r2 += dx * dx;
    }
    if (r2 <= reach * reach) pairs.push_back(pair);
  }

  PeriodicCell<D> cell_;
  std::array<std::size_t, Dimension<D>::lateral> strips_{};
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> strip_;
  std::vector<std::size_t> strip_begin_;
};

/// Every grain at every step, pairs from a plain Verlet list.
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
    const BaseState base = physics_.base_at_step(step_in_cycle_);
    base_force_ = 0;
    for (const auto i : near_base_) {
      const double overlap = grains_.base_overlap(i, base);
      if (overlap <= 0) continue;
      const bool begins = base_touched_[i] != step_stamp_ - 1;
      base_force_ += grains_.touch_base(physics_, i, base, overlap, begins, ledger_);
      base_touched_[i] = step_stamp_;
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

  double elastic_energy() const {
    const BaseState base = physics_.base_at_step(step_in_cycle_);
    double energy = 0;
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
    const double travelled = std::sqrt(largest_squared(
        [&](int c, std::size_t i) { return grains_.position[c][i] - built_at_[c][i]; }));
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
    for (const auto& old : touching_before) mark_touching(old);
    built_at_ = grains_.position;
    near_base_.clear();
    for (std::uint32_t i = 0; i < grains_.count(); ++i) {
      if (grains_.position[vertical][i] < physics_.base.amplitude + grain_radius + 0.5 * skin_) {
        near_base_.push_back(i);
      }
    }
    base_touched_.resize(grains_.count(), -1);
    steps_until_list_check_ = safe_steps(0.5 * skin_);
  }

  void mark_touching(const NeighbourPair<D>& old) {
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const bool same = (pairs_[k].i == old.i && pairs_[k].j == old.j) ||
                        (pairs_[k].i == old.j && pairs_[k].j == old.i);
      if (same) pair_touched_[k] = step_stamp_;
    }
  }

  Physics physics_;
  LeapfrogGrains<Physics> grains_;
  EnergyLedger ledger_;
  double base_force_ = 0;

  NeighbourSearch<D> search_;
  std::vector<NeighbourPair<D>> pairs_;
  std::vector<long> pair_touched_;  ///< the last step at which the pair touched
  std::vector<long> base_touched_;
  std::vector<std::uint32_t> near_base_;
  GrainState state_;
  Columns<D> built_at_;
  double skin_ = 0;
  long list_builds_ = 0;
  long step_stamp_ = 0;
  long step_in_cycle_ = 0;
  long steps_until_list_check_ = 1;
};

}  // namespace shakebed::baseline
