#pragma once

#include <cmath>
#include <cstdint>

#include "simulator/boundary/base.hpp"
#include "simulator/boundary/periodic.hpp"
#include "simulator/contact/contact.hpp"
#include "simulator/contact/linear_spring_dashpot.hpp"
#include "simulator/grains/grains.hpp"
#include "simulator/observables/energy_ledger.hpp"

namespace shakebed::simulator {

/// Everything a bed's motion needs beside its grains, bound once.
template <int D, class Tangential>
struct BedPhysics {
  using TangentialLaw = Tangential;
  static constexpr int dimension = D;
  static constexpr bool turns_grains = Tangential::turns_grains;
  static constexpr bool walled = false;  ///< by more than the base; see walled_physics.hpp
  using GrainState = Grains<D, turns_grains>;
  using ContactLaw = Contact<D, LinearSpringDashpot, Tangential>;

  PeriodicCell<D> cell;
  ContactLaw grain_grain;
  ContactLaw grain_base;
  BaseMotion base;
  double gravity;
  double time_step;
  long steps_per_cycle;

  BaseState base_at_step(long step_in_cycle) const {
    return base.at(static_cast<double>(step_in_cycle) / static_cast<double>(steps_per_cycle));
  }
  bool periodic(int) const { return true; }
};

/// Grains on the global time grid, in the leapfrog form of velocity Verlet: positions and
/// accelerations at step n, velocities at n - 1/2. Forces that depend on velocity use velocities
/// predicted to the time of the positions, v_pred(n) = v(n - 1/2) + a(n - 1) dt/2. (With the
/// half-step velocity itself T_z is biased low by 1-2 % at t_c/25.)
template <class Physics>
struct LeapfrogGrains {
  static constexpr int D = Physics::dimension;
  static constexpr bool turns_grains = Physics::turns_grains;
  static constexpr int S = Physics::GrainState::spin_columns;
  static constexpr int vertical = Dimension<D>::vertical;

  Columns<D> position;
  Columns<D> half_velocity;
  Columns<D> predicted_velocity;
  Columns<D> acceleration;
  Columns<S> half_spin;
  Columns<S> predicted_spin;
  Columns<S> spin_acceleration;

  std::size_t count() const { return position[0].size(); }

  void resize_to(std::size_t n) {
    for (auto* columns : {&position, &half_velocity, &predicted_velocity, &acceleration}) {
      resize(*columns, n);
    }
    for (auto* columns : {&half_spin, &predicted_spin, &spin_acceleration}) resize(*columns, n);
  }

  /// v(n+1/2) and x(n+1) from v(n-1/2) and a(n); v predicted to n+1; accelerations are left at
  /// gravity's, for the contacts of step n+1 to add to.
  void kick_drift_predict(const Physics& physics) {
    const double dt = physics.time_step;
    const double h = 0.5 * dt;
    const std::size_t n = count();
    for (int c = 0; c < D; ++c) {
      const double external = c == vertical ? -physics.gravity : 0.0;
      double* __restrict half = half_velocity[c].data();
      double* __restrict x = position[c].data();
      double* __restrict predicted = predicted_velocity[c].data();
      double* __restrict a = acceleration[c].data();
      for (std::size_t i = 0; i < n; ++i) {
        half[i] += dt * a[i];
        x[i] += dt * half[i];
        predicted[i] = half[i] + h * a[i];
        a[i] = external;
      }
    }
    for (int c = 0; c < S; ++c) {
      double* __restrict half = half_spin[c].data();
      double* __restrict predicted = predicted_spin[c].data();
      double* __restrict a = spin_acceleration[c].data();
      for (std::size_t i = 0; i < n; ++i) {
        half[i] += dt * a[i];
        predicted[i] = half[i] + h * a[i];
        a[i] = 0;
      }
    }
  }

  /// Adds the contact of rows i and j, whose centres are `r` apart (from i to j).
  [[gnu::always_inline]] inline void touch_pair(const Physics& physics, std::size_t i,
                                                std::size_t j, const Vector<D>& r, double r2,
                                                bool begins, EnergyLedger& ledger) {
    const double distance = std::sqrt(r2);
    const Vector<D> n = r / distance;
    const double overlap = 2 * grain_radius - distance;
    const Vector<D> v = row(predicted_velocity, i) - row(predicted_velocity, j);
    Spin<D> spin_radius = Spin<D>::Zero();
    if constexpr (turns_grains) {
      spin_radius = grain_radius * (row(predicted_spin, i) + row(predicted_spin, j));
    }
    const auto f = physics.grain_grain(n, overlap, v, spin_radius);
    add_to_row(acceleration, i, f.force);
    add_to_row(acceleration, j, Vector<D>(-f.force));
    if constexpr (turns_grains) {
      const Spin<D> turn = (grain_radius / grain_inertia) * f.moment_per_radius;
      add_to_row(spin_acceleration, i, turn);
      add_to_row(spin_acceleration, j, turn);
    }
    ledger.dissipation += f.dissipated_power * physics.time_step;
    ledger.count_step(overlap, begins);
  }

  /// Adds the contact of row i with the base; returns the vertical force on the grain.
  double touch_base(const Physics& physics, std::size_t i, const BaseState& base, double overlap,
                    bool begins, EnergyLedger& ledger) {
    Vector<D> n = Vector<D>::Zero();
    n[vertical] = -1;
    return touch_plane(physics, physics.grain_base, i, n, vertical, base.velocity, overlap, begins,
                       ledger)[vertical];
  }

  /// Adds the contact of row i with a wall; returns the force on the grain along the wall's normal.
  template <class Wall>
  double touch_wall(const Physics& physics, const Wall& wall, std::size_t i, const BaseState& base,
                    double overlap, bool begins, EnergyLedger& ledger) {
    Vector<D> n = Vector<D>::Zero();
    n[wall.axis] = -wall.inward;
    return wall.inward * touch_plane(physics, wall.law, i, n, wall.drive_axis,
                                     wall.moves ? base.velocity : 0, overlap, begins,
                                     ledger)[wall.axis];
  }

  double base_overlap(std::size_t i, const BaseState& base) const {
    return base.height + grain_radius - position[vertical][i];
  }

 private:
  /// Adds the contact of row i with a plane towards which `n` points and which moves along one axis
  /// at `plane_velocity`; returns the force on the grain.
  template <class Law>
  Vector<D> touch_plane(const Physics& physics, const Law& law, std::size_t i, const Vector<D>& n,
                        int drive_axis, double plane_velocity, double overlap, bool begins,
                        EnergyLedger& ledger) {
    Vector<D> v = row(predicted_velocity, i);
    v[drive_axis] -= plane_velocity;
    Spin<D> spin_radius = Spin<D>::Zero();
    if constexpr (turns_grains) spin_radius = grain_radius * row(predicted_spin, i);
    const auto f = law(n, overlap, v, spin_radius);
    add_to_row(acceleration, i, f.force);
    if constexpr (turns_grains) {
      add_to_row(spin_acceleration, i,
                 Spin<D>((grain_radius / grain_inertia) * f.moment_per_radius));
    }
    ledger.base_work += f.force[drive_axis] * plane_velocity * physics.time_step;
    ledger.dissipation += f.dissipated_power * physics.time_step;
    ledger.count_step(overlap, begins);
    return f.force;
  }
};

}  // namespace shakebed::simulator
