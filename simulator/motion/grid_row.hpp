#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "simulator/lanes.hpp"
#include "simulator/motion/leapfrog.hpp"

namespace shakebed::simulator {

/// One grain on the global time grid, everything of it side by side: velocity Verlet in leapfrog
/// form, step by step the same numbers as LeapfrogGrains. Velocity and spin share one row of
/// numbers (v, then omega), each padded to a power of two, so that one instruction moves them all.
template <class Physics>
struct GridRow {
  static constexpr int D = Physics::dimension;
  static constexpr int S = Physics::GrainState::spin_columns;
  static constexpr int vertical = Dimension<D>::vertical;
  static constexpr std::size_t room = std::bit_ceil(static_cast<unsigned>(D));
  static constexpr std::size_t spin_first = room;  ///< in a row of rates
  static constexpr std::size_t width = S == 0 ? room : std::bit_ceil(room + S);
  using SpinRow = Eigen::Matrix<double, S, 1>;
  using Rates = std::array<double, width>;
  /// Rates as one register (or a few).
  using RateLanes =
      std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, width>>;
  using PlaceLanes =
      std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, room>>;
  using Shift = std::array<double, Dimension<D>::lateral>;

  alignas(width * sizeof(double)) Rates half{};  ///< velocity and spin half a step ago
  Rates predicted{};                             ///< the same, predicted to now
  Rates change{};                                ///< acceleration and spin acceleration now
  alignas(room * sizeof(double)) std::array<double, room> x{};

  /// A freely flying grain at this step.
  void set_flying(const Vector<D>& position, const Vector<D>& v, const SpinRow& spin,
                  const Physics& physics) {
    for (int c = 0; c < D; ++c) {
      x[c] = position[c];
      half[c] = v[c];
      change[c] = 0;
    }
    for (int c = 0; c < S; ++c) {
      half[spin_first + c] = spin[c];
      change[spin_first + c] = 0;
    }
    half[vertical] += 0.5 * physics.time_step * physics.gravity;
    change[vertical] = -physics.gravity;
  }

  Vector<D> position() const { return first<D>(x); }
  Vector<D> half_velocity() const { return first<D>(half); }
  Vector<D> velocity_now(double time_step) const {
    Vector<D> v;
    for (int c = 0; c < D; ++c) v[c] = half[c] + 0.5 * time_step * change[c];
    return v;
  }
  SpinRow spin_now(double time_step) const {
    SpinRow spin;
    for (int c = 0; c < S; ++c)
      spin[c] = half[spin_first + c] + 0.5 * time_step * change[spin_first + c];
    return spin;
  }
  double half_speed_squared() const { return half_velocity().squaredNorm(); }

  /// Velocity, spin and position one step on; change is left at gravity's. (What moves along behind
  /// the position is padding.)
  [[gnu::always_inline]] void kick_drift_predict(double dt, double gravity) {
    const RateLanes a = load(change);
    const RateLanes v = load(half) + dt * a;
    store(half, v);
    store(predicted, v + 0.5 * dt * a);
    store(change, RateLanes([&](auto c) { return c == vertical ? -gravity : 0.0; }));
    (place(x.data()) + dt * place(half.data()))
        .copy_to(x.data(), std::experimental::element_aligned);
  }

  /// As many steps without any contact.
  void fly(long steps, double dt, double gravity) {
    const Vector<D> way = flown(steps, dt, gravity);
    for (int c = 0; c < D; ++c) x[c] += way[c];
    half[vertical] -= static_cast<double>(steps) * dt * gravity;
  }
  /// How far they take it.
  Vector<D> flown(long steps, double dt, double gravity) const {
    const auto n = static_cast<double>(steps);
    Vector<D> way = n * dt * half_velocity();
    way[vertical] -= 0.5 * n * (n + 1) * dt * dt * gravity;
    return way;
  }

  double base_overlap(const BaseState& base) const {
    return base.height + grain_radius - x[vertical];
  }

  // Rates are read and written whole: a wide load would have to wait for narrow stores before it.
  static PlaceLanes place(const double* from) {
    return PlaceLanes(from, std::experimental::element_aligned);
  }
  static RateLanes load(const Rates& rates) {
    return RateLanes(rates.data(), std::experimental::element_aligned);
  }
  static void store(Rates& rates, const RateLanes& lanes) {
    lanes.copy_to(rates.data(), std::experimental::element_aligned);
  }
  static RateLanes lanes_of(const Vector<D>& linear, const Spin<D>& angular) {
    return RateLanes([&](auto c) -> double {
      if constexpr (c < D) return linear[c];
      if constexpr (c >= spin_first && c < spin_first + S) return angular[c - spin_first];
      return 0;
    });
  }
  /// -1 for velocities, which differ in a relative motion, and 1 for spins, which add.
  static RateLanes signs() {
    return RateLanes([](auto c) { return c < spin_first ? -1.0 : 1.0; });
  }

  Vector<D> predicted_velocity() const { return first<D>(predicted); }
  Spin<D> predicted_spin() const {
    Spin<D> spin = Spin<D>::Zero();
    for (int c = 0; c < S; ++c) spin[c] = predicted[spin_first + c];
    return spin;
  }

 private:
  template <int N, std::size_t M>
  static Eigen::Matrix<double, N, 1> first(const std::array<double, M>& numbers) {
    Eigen::Matrix<double, N, 1> v;
    for (int c = 0; c < N; ++c) v[c] = numbers[c];
    return v;
  }
};

/// From a to the image of b that `shift` names.
template <class Physics>
inline Vector<Physics::dimension> separation(const GridRow<Physics>& a, const GridRow<Physics>& b,
                                             const typename GridRow<Physics>::Shift& shift) {
  constexpr int D = Physics::dimension;
  Vector<D> r;
  for (int c = 0; c < D; ++c) {
    r[c] = b.x[c] - a.x[c];
    if (c < Dimension<D>::lateral) r[c] += shift[c];
  }
  return r;
}

/// Adds the contact of rows a and b, `r` apart.
template <class Physics>
[[gnu::always_inline]] inline void touch_pair(const Physics& physics, GridRow<Physics>& a,
                                              GridRow<Physics>& b,
                                              const Vector<Physics::dimension>& r, double r2,
                                              bool begins, EnergyLedger& ledger) {
  constexpr int D = Physics::dimension;
  const double distance = std::sqrt(r2);
  const Vector<D> n = r / distance;
  const double overlap = 2 * grain_radius - distance;
  const Vector<D> v = a.predicted_velocity() - b.predicted_velocity();
  const Spin<D> spin_radius = grain_radius * (a.predicted_spin() + b.predicted_spin());
  const auto f = physics.grain_grain(n, overlap, v, spin_radius);
  using Row = GridRow<Physics>;
  const auto change =
      Row::lanes_of(f.force, Spin<D>((grain_radius / grain_inertia) * f.moment_per_radius));
  Row::store(a.change, Row::load(a.change) + change);
  Row::store(b.change, Row::load(b.change) + Row::signs() * change);
  ledger.dissipation += f.dissipated_power * physics.time_step;
  ledger.count_step(overlap, begins);
}

/// Adds the contact of a row with a plane towards which `n` points and which moves along one axis
/// at `plane_velocity`.
template <class Physics, class Law>
inline void touch_plane(const Physics& physics, const Law& law, GridRow<Physics>& row,
                        const Vector<Physics::dimension>& n, int drive_axis, double plane_velocity,
                        double overlap, bool begins, EnergyLedger& ledger) {
  constexpr int D = Physics::dimension;
  Vector<D> v = row.predicted_velocity();
  v[drive_axis] -= plane_velocity;
  const auto f = law(n, overlap, v, Spin<D>(grain_radius * row.predicted_spin()));
  using Row = GridRow<Physics>;
  const auto change =
      Row::lanes_of(f.force, Spin<D>((grain_radius / grain_inertia) * f.moment_per_radius));
  Row::store(row.change, Row::load(row.change) + change);
  ledger.base_work += f.force[drive_axis] * plane_velocity * physics.time_step;
  ledger.dissipation += f.dissipated_power * physics.time_step;
  ledger.count_step(overlap, begins);
}

/// Adds the contact of a row with the base.
template <class Physics>
inline void touch_base(const Physics& physics, GridRow<Physics>& row, const BaseState& base,
                       double overlap, bool begins, EnergyLedger& ledger) {
  constexpr int vertical = Dimension<Physics::dimension>::vertical;
  Vector<Physics::dimension> n = Vector<Physics::dimension>::Zero();
  n[vertical] = -1;
  touch_plane(physics, physics.grain_base, row, n, vertical, base.velocity, overlap, begins,
              ledger);
}

}  // namespace shakebed::simulator
