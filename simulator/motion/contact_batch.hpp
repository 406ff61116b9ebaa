#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulator/lanes.hpp"
#include "simulator/motion/grid_row.hpp"

namespace shakebed::simulator {

/// Contacts evaluated several at a time: their relative motions are gathered, the contact law runs
/// over lanes of them, and the forces are added back to the grains one by one, in the order in
/// which the contacts came. Each contact gets the very numbers it would get alone.
template <class Physics>
class ContactBatch {
 public:
  static constexpr int D = Physics::dimension;
  static constexpr int S = Physics::GrainState::spin_columns;
  static constexpr int vertical = Dimension<D>::vertical;
  static constexpr std::size_t capacity = 64;
  using Row = GridRow<Physics>;
  static constexpr std::size_t width = Row::width;

  bool full() const { return count_ == capacity; }

  /// Gathers the pair of rows (i, j), `shift` taking x_j - x_i to the image meant.
  void add_pair(const Row* rows, std::uint32_t i, std::uint32_t j,
                const typename Row::Shift& shift) {
    const std::size_t k = count_++;
    const Row& a = rows[i];
    const Row& b = rows[j];
    i_[k] = i;
    j_[k] = j;
    for (std::size_t c = 0; c < Row::room; ++c) separation_[k][c] = b.x[c] - a.x[c];
    for (int c = 0; c < Dimension<D>::lateral; ++c) separation_[k][c] += shift[c];
    Row::store(motion_[k], Row::load(a.predicted) + Row::signs() * Row::load(b.predicted));
  }

  /// Gathers the contact of row i with the base.
  void add_base(const Row* rows, std::uint32_t i, const BaseState& base, double overlap) {
    const std::size_t k = count_++;
    i_[k] = i;
    overlap_[k] = overlap;
    motion_[k] = rows[i].predicted;
    motion_[k][vertical] -= base.velocity;
  }

  /// Adds the forces of the pairs gathered; `apart(k)` is told of those that do not touch.
  template <class Apart>
  void apply_pairs(const Physics& physics, Row* rows, EnergyLedger& ledger, Apart apart) {
    for (std::size_t k = 0; k < count_; k += lane_count) {
      Vector<D, Lanes> r;
      for (int c = 0; c < D; ++c) r[c] = column(separation_, k, c);
      const Lanes distance = std::experimental::sqrt(r.squaredNorm());
      const Vector<D, Lanes> n = r / distance;
      const Lanes overlap = 2 * grain_radius - distance;
      store_lanes(&overlap_[k], overlap);
      evaluate(physics.grain_grain, n, overlap, k);
    }
    for (std::size_t k = 0; k < count_; ++k) {
      if (overlap_[k] <= 0) [[unlikely]] {
        apart(k);
        continue;
      }
      Row& a = rows[i_[k]];
      Row& b = rows[j_[k]];
      const auto change = change_of(k);
      Row::store(a.change, Row::load(a.change) + change);
      Row::store(b.change, Row::load(b.change) + Row::signs() * change);
      book(physics, k, ledger);
    }
    count_ = 0;
  }

  /// Adds the forces of the contacts with the base.
  void apply_base(const Physics& physics, const BaseState& base, Row* rows, EnergyLedger& ledger) {
    Vector<D, Lanes> n = Vector<D, Lanes>::Constant(Lanes(0));
    n[vertical] = -1;
    for (std::size_t k = 0; k < count_; k += lane_count) {
      evaluate(physics.grain_base, n, load_lanes(&overlap_[k]), k);
    }
    for (std::size_t k = 0; k < count_; ++k) {
      Row& row = rows[i_[k]];
      Row::store(row.change, Row::load(row.change) + change_of(k));
      ledger.base_work += change_[vertical][k] * base.velocity * physics.time_step;
      book(physics, k, ledger);
    }
    count_ = 0;
  }

 private:
  template <std::size_t W>
  using Table = std::array<std::array<double, W>, capacity>;
  using Column = std::array<double, capacity>;

  template <std::size_t W>
  static Lanes column(const Table<W>& table, std::size_t k, int c) {
    return Lanes([&](std::size_t lane) { return table[k + lane][c]; });
  }

  typename Row::RateLanes change_of(std::size_t k) const {
    return typename Row::RateLanes([&](auto c) -> double {
      if constexpr (c < D + S) return change_[c][k];
      return 0;
    });
  }

  [[gnu::always_inline]] inline void evaluate(const typename Physics::ContactLaw& law,
                                              const Vector<D, Lanes>& n, const Lanes& overlap,
                                              std::size_t k) {
    Vector<D, Lanes> v;
    Spin<D, Lanes> spin_radius = Spin<D, Lanes>::Constant(Lanes(0));
    for (int c = 0; c < D; ++c) v[c] = column(motion_, k, c);
    for (int c = 0; c < S; ++c) spin_radius[c] = grain_radius * column(motion_, k, D + c);
    const auto f = law.template operator()<Lanes>(n, overlap, v, spin_radius);
    for (int c = 0; c < D; ++c) store_lanes(&change_[c][k], f.force[c]);
    for (int c = 0; c < S; ++c) {
      store_lanes(&change_[D + c][k], (grain_radius / grain_inertia) * f.moment_per_radius[c]);
    }
    store_lanes(&dissipated_power_[k], f.dissipated_power);
  }

  void book(const Physics& physics, std::size_t k, EnergyLedger& ledger) const {
    ledger.dissipation += dissipated_power_[k] * physics.time_step;
    ledger.count_step(overlap_[k], false);
  }

  // Tables end on whole lanes: what lies behind the last contact is computed and not used.
  alignas(64) Table<Row::room> separation_{};
  alignas(64) Table<width> motion_{};
  alignas(64) std::array<Column, width> change_{};
  alignas(64) Column overlap_{};
  alignas(64) Column dissipated_power_{};
  std::array<std::uint32_t, capacity> i_{};
  std::array<std::uint32_t, capacity> j_{};
  std::size_t count_ = 0;
};

}  // namespace shakebed::simulator
