#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulator/boundary/base.hpp"
#include "simulator/boundary/periodic.hpp"
#include "simulator/contact/contact.hpp"
#include "simulator/contact/linear_spring_dashpot.hpp"
#include "simulator/grains/grains.hpp"
#include "simulator/motion/neighbours.hpp"
#include "simulator/observables/energy_ledger.hpp"

namespace shakebed::simulator {

/// Everything a bed's motion needs beside its grains, bound once.
template <int D, class Tangential>
struct BedPhysics {
  using TangentialLaw = Tangential;
  static constexpr int dimension = D;
  static constexpr bool turns_grains = Tangential::turns_grains;
  using GrainState = Grains<D, turns_grains>;
  using ContactLaw = Contact<D, LinearSpringDashpot, Tangential>;

  PeriodicCell<D> cell;
  ContactLaw grain_grain;
  ContactLaw grain_base;
  BaseMotion base;
  double gravity;
  double time_step;
  long steps_per_cycle;
};

/// Reference integrator: velocity Verlet in its leapfrog form, every grain at every step, forces
/// that depend on velocity evaluated with velocities predicted to the time of the positions,
/// v_pred(t) = v(t - dt/2) + a(t - dt) dt/2. (With the half-step velocity itself T_z is biased low
/// by 1-2 % at t_c/25.)
template <class Physics>
class UniformStepper {
 public:
  static constexpr int D = Physics::dimension;
  static constexpr bool turns_grains = Physics::turns_grains;
  using GrainState = typename Physics::GrainState;
  static constexpr int S = GrainState::spin_columns;

  /// Starts at step 0 of a cycle (the base at its mean height, moving up).
  UniformStepper(const Physics& physics, const GrainState& start)
      : physics_(physics), state_(start), search_(physics.cell) {
    const std::size_t n = start.count();
    resize(half_velocity_, n);
    resize(acceleration_, n);
    resize(half_spin_, n);
    resize(spin_acceleration_, n);
    rebuild();
    ++step_stamp_;
    reset_accelerations();
    accumulate_contacts();
    ledger_ = {};
    for (int c = 0; c < D; ++c) {
      for (std::size_t i = 0; i < n; ++i) {
        half_velocity_[c][i] =
            state_.velocity[c][i] - 0.5 * physics_.time_step * acceleration_[c][i];
      }
    }
    for (int c = 0; c < S; ++c) {
      for (std::size_t i = 0; i < n; ++i) {
        half_spin_[c][i] = state_.spin[c][i] - 0.5 * physics_.time_step * spin_acceleration_[c][i];
      }
    }
  }

  void advance(long steps) {
    for (long s = 0; s < steps; ++s) step();
  }

  /// Positions, velocities and spins at the present step.
  const GrainState& synchronised() {
    const double h = 0.5 * physics_.time_step;
    for (int c = 0; c < D; ++c) {
      for (std::size_t i = 0; i < state_.count(); ++i) {
        state_.velocity[c][i] = half_velocity_[c][i] + h * acceleration_[c][i];
      }
    }
    for (int c = 0; c < S; ++c) {
      for (std::size_t i = 0; i < state_.count(); ++i) {
        state_.spin[c][i] = half_spin_[c][i] + h * spin_acceleration_[c][i];
      }
    }
    return state_;
  }

  /// Multiplies every velocity and spin: an artificial cooling, used only while settling.
  void damp(double factor) {
    for (auto& column : half_velocity_) {
      for (double& v : column) v *= factor;
    }
    for (auto& column : half_spin_) {
      for (double& omega : column) omega *= factor;
    }
  }

  double kinetic_energy() { return mechanical_energy(synchronised(), 0); }

  EnergyLedger& ledger() { return ledger_; }
  long step_in_cycle() const { return step_in_cycle_; }
  const std::vector<NeighbourPair<D>>& neighbour_pairs() const { return pairs_; }

  /// Kinetic, potential and stored elastic energy [m g d].
  double energy() { return mechanical_energy(synchronised(), physics_.gravity) + elastic_energy(); }

  /// Sum of the vertical forces the base puts on grains, averaged over nothing: this step's.
  double base_force() const { return base_force_; }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  void step() {
    if (--steps_until_list_check_ <= 0) check_list();
    if (++step_in_cycle_ == physics_.steps_per_cycle) step_in_cycle_ = 0;
    ++step_stamp_;
    kick_drift_predict();
    accumulate_contacts();
  }

  /// v(t+dt/2) from v(t-dt/2), x(t+dt), and v predicted to t+dt (left in state_.velocity).
  void kick_drift_predict() {
    const double dt = physics_.time_step;
    const double h = 0.5 * dt;
    const std::size_t n = state_.count();
    for (int c = 0; c < D; ++c) {
      const double external = c == vertical ? -physics_.gravity : 0.0;
      double* __restrict half = half_velocity_[c].data();
      double* __restrict x = state_.position[c].data();
      double* __restrict predicted = state_.velocity[c].data();
      double* __restrict a = acceleration_[c].data();
      for (std::size_t i = 0; i < n; ++i) {
        half[i] += dt * a[i];
        x[i] += dt * half[i];
        predicted[i] = half[i] + h * a[i];
        a[i] = external;
      }
    }
    for (int c = 0; c < S; ++c) {
      double* __restrict half = half_spin_[c].data();
      double* __restrict predicted = state_.spin[c].data();
      double* __restrict a = spin_acceleration_[c].data();
      for (std::size_t i = 0; i < n; ++i) {
        half[i] += dt * a[i];
        predicted[i] = half[i] + h * a[i];
        a[i] = 0;
      }
    }
  }

  void reset_accelerations() {
    for (int c = 0; c < D; ++c) {
      std::fill(acceleration_[c].begin(), acceleration_[c].end(),
                c == vertical ? -physics_.gravity : 0.0);
    }
    for (auto& column : spin_acceleration_) std::fill(column.begin(), column.end(), 0.0);
  }

  void accumulate_contacts() {
    accumulate_base();
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto& pair = pairs_[k];
      Vector<D> r;
      for (int c = 0; c < D; ++c) {
        r[c] = state_.position[c][pair.j] - state_.position[c][pair.i];
        if (c < Dimension<D>::lateral) r[c] += pair.shift[c];
      }
      const double r2 = r.squaredNorm();
      if (r2 < 4 * grain_radius * grain_radius) [[unlikely]] {
        touch_pair(pair, r, r2, pair_touched_[k]);
      }
    }
  }

  void touch_pair(const NeighbourPair<D>& pair, const Vector<D>& r, double r2, long& touched) {
    const double distance = std::sqrt(r2);
    const Vector<D> n = r / distance;
    const double overlap = 2 * grain_radius - distance;
    const Vector<D> v = row(state_.velocity, pair.i) - row(state_.velocity, pair.j);
    Spin<D> spin_radius = Spin<D>::Zero();
    if constexpr (turns_grains) {
      spin_radius = grain_radius * (row(state_.spin, pair.i) + row(state_.spin, pair.j));
    }
    const auto f = physics_.grain_grain(n, overlap, v, spin_radius);
    add_to_row(acceleration_, pair.i, f.force);
    add_to_row(acceleration_, pair.j, Vector<D>(-f.force));
    if constexpr (turns_grains) {
      const Spin<D> turn = (grain_radius / grain_inertia) * f.moment_per_radius;
      add_to_row(spin_acceleration_, pair.i, turn);
      add_to_row(spin_acceleration_, pair.j, turn);
    }
    ledger_.dissipation += f.dissipated_power * physics_.time_step;
    ledger_.count_step(overlap, touched != step_stamp_ - 1);
    touched = step_stamp_;
  }

  void accumulate_base() {
    const BaseState base = physics_.base.at(static_cast<double>(step_in_cycle_) /
                                            static_cast<double>(physics_.steps_per_cycle));
    base_force_ = 0;
    for (const auto i : near_base_) {
      const double overlap = base.height + grain_radius - state_.position[vertical][i];
      if (overlap > 0) touch_base(i, base, overlap);
    }
  }

  void touch_base(std::uint32_t i, const BaseState& base, double overlap) {
    Vector<D> n = Vector<D>::Zero();
    n[vertical] = -1;
    Vector<D> v = row(state_.velocity, i);
    v[vertical] -= base.velocity;
    Spin<D> spin_radius = Spin<D>::Zero();
    if constexpr (turns_grains) spin_radius = grain_radius * row(state_.spin, i);
    const auto f = physics_.grain_base(n, overlap, v, spin_radius);
    add_to_row(acceleration_, i, f.force);
    if constexpr (turns_grains) {
      add_to_row(spin_acceleration_, i,
                 Spin<D>((grain_radius / grain_inertia) * f.moment_per_radius));
    }
    base_force_ += f.force[vertical];
    ledger_.base_work += f.force[vertical] * base.velocity * physics_.time_step;
    ledger_.dissipation += f.dissipated_power * physics_.time_step;
    ledger_.count_step(overlap, base_touched_[i] != step_stamp_ - 1);
    base_touched_[i] = step_stamp_;
  }

  double elastic_energy() const {
    const BaseState base = physics_.base.at(static_cast<double>(step_in_cycle_) /
                                            static_cast<double>(physics_.steps_per_cycle));
    double energy = 0;
    for (const auto i : near_base_) {
      const double overlap = base.height + grain_radius - state_.position[vertical][i];
      if (overlap > 0) energy += physics_.grain_base.normal.stored_energy(overlap);
    }
    for (const auto& pair : pairs_) {
      const double overlap = 2 * grain_radius - separation(pair);
      if (overlap > 0) energy += physics_.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

  double separation(const NeighbourPair<D>& pair) const {
    Vector<D> r = row(state_.position, pair.j) - row(state_.position, pair.i);
    for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += pair.shift[c];
    return r.norm();
  }

  /// Keeps the list while no grain can have moved by half the skin before the next look.
  void check_list() {
    const double travelled = std::sqrt(largest_squared(
        [&](int c, std::size_t i) { return state_.position[c][i] - built_at_[c][i]; }));
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
           2 * std::sqrt(
                   largest_squared([&](int c, std::size_t i) { return half_velocity_[c][i]; }));
  }

  template <class Component>
  double largest_squared(Component component) const {
    double largest = 0;
    for (std::size_t i = 0; i < state_.count(); ++i) {
      double square = 0;
      for (int c = 0; c < D; ++c) square += component(c, i) * component(c, i);
      largest = std::max(largest, square);
    }
    return largest;
  }

  /// A skin that lasts about 160 steps at present speeds (half of speed_bound): longer lists cost
  /// every step, more frequent builds cost a search each.
  void rebuild() {
    const double widest = 0.5 * physics_.cell.narrowest() - 2 * grain_radius;
    skin_ = std::clamp(2 * 80 * speed_bound() * physics_.time_step, std::min(0.1, widest),
                       std::min(1.0, widest));
    std::vector<NeighbourPair<D>> touching_before;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      if (pair_touched_[k] == step_stamp_) touching_before.push_back(pairs_[k]);
    }
    search_.find(state_.position, 2 * grain_radius + skin_, pairs_);
    pair_touched_.assign(pairs_.size(), -1);
    for (const auto& old : touching_before) mark_touching(old);
    built_at_ = state_.position;
    near_base_.clear();
    for (std::uint32_t i = 0; i < state_.count(); ++i) {
      if (state_.position[vertical][i] < physics_.base.amplitude + grain_radius + 0.5 * skin_) {
        near_base_.push_back(i);
      }
    }
    base_touched_.resize(state_.count(), -1);
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
  GrainState state_;
  Columns<D> half_velocity_;
  Columns<D> acceleration_;
  Columns<S> half_spin_;
  Columns<S> spin_acceleration_;
  EnergyLedger ledger_;
  double base_force_ = 0;

  NeighbourSearch<D> search_;
  std::vector<NeighbourPair<D>> pairs_;
  std::vector<long> pair_touched_;  ///< the last step at which the pair touched
  std::vector<long> base_touched_;
  std::vector<std::uint32_t> near_base_;
  Columns<D> built_at_;
  double skin_ = 0;
  long step_stamp_ = 0;
  long step_in_cycle_ = 0;
  long steps_until_list_check_ = 1;
};

}  // namespace shakebed::simulator
