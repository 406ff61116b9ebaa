#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "simulator/motion/grid_row.hpp"

namespace shakebed::simulator {

/// The few grains that are stepped on the global time grid while the others fly: those in contact
/// and those that might touch them soon. Steps here equal the uniform engine's to rounding. Which
/// grains belong is the engine's business; this class moves them and says when to look again.
template <class Physics>
class FineContacts {
 public:
  static constexpr int D = Physics::dimension;
  using SpinRow = typename GridRow<Physics>::SpinRow;

  struct Row {
    GridRow<Physics> grain;
    std::uint32_t id;
    double speed_cap = 0;    ///< it moves no faster before `expires`
    long expires = 0;        ///< step at which its surroundings must be looked at again
    long base_touched = -1;  ///< the last step at which it touched the base
    bool near_base = false;  ///< it may touch the base before `expires`
    bool fresh = true;       ///< came to touch, and has not yet
  };

  struct Pair {
    std::uint32_t a;  ///< rows
    std::uint32_t b;
    typename GridRow<Physics>::Shift shift;
    long touched;  ///< the last step at which they touched
  };

  std::vector<Row> rows;
  std::vector<Pair> pairs;       ///< all that may touch before the sooner of their rows expires
  bool needs_attention = false;  ///< a contact ended, a row expired or outran its cap

  std::size_t count() const { return rows.size(); }

  std::size_t add(std::uint32_t grain, const Vector<D>& x, const Vector<D>& v, const SpinRow& spin,
                  bool fresh, const Physics& physics) {
    rows.emplace_back();
    Row& row = rows.back();
    row.grain.set_flying(x, v, spin, physics);
    row.id = grain;
    row.fresh = fresh;
    return rows.size() - 1;
  }

  /// One step of the grid, arriving at `step` (of the run).
  void advance(const Physics& physics, long step, EnergyLedger& ledger) {
    needs_attention = false;
    BaseState base{};
    bool base_known = false;
    for (Row& row : rows) {
      row.grain.kick_drift_predict(physics.time_step, physics.gravity);
      if (!row.near_base) continue;
      if (!base_known) base = physics.base_at_step(step % physics.steps_per_cycle);
      base_known = true;
      const double overlap = row.grain.base_overlap(base);
      if (overlap > 0) {
        touch_base(physics, row.grain, base, overlap, row.base_touched != step - 1, ledger);
        row.base_touched = step;
        row.fresh = false;
      } else if (row.base_touched == step - 1) {
        needs_attention = true;
      }
    }
    for (Pair& pair : pairs) {
      GridRow<Physics>& a = rows[pair.a].grain;
      GridRow<Physics>& b = rows[pair.b].grain;
      const Vector<D> r = separation(a, b, pair.shift);
      const double rr = r.squaredNorm();
      if (rr < 4 * grain_radius * grain_radius) {
        touch_pair(physics, a, b, r, rr, pair.touched != step - 1, ledger);
        pair.touched = step;
        rows[pair.a].fresh = rows[pair.b].fresh = false;
      } else if (pair.touched == step - 1) {
        needs_attention = true;
      }
    }
    for (Row& row : rows) {
      if (row.grain.half_speed_squared() > row.speed_cap * row.speed_cap) row.expires = step;
      if (row.expires > step) continue;
      needs_attention = true;
      // Grains side by side in one motion may be told for ever to touch now, and by a rounding do
      // not: whoever came for a touch waits for it until it looks around again.
      row.fresh = false;
    }
  }

  /// Lists a pair that touches at `step`.
  void link(std::size_t a, std::size_t b, long step, const PeriodicCell<D>& cell) {
    const auto i = static_cast<std::uint32_t>(a);
    const auto j = static_cast<std::uint32_t>(b);
    pairs.push_back({i, j, image_shift(i, j, cell), step});
  }

  /// Forgets the pairs of row k that do not touch at `step`, and lists those within `reach(b)`.
  template <class Reach>
  void list_pairs(std::uint32_t k, long step, const PeriodicCell<D>& cell, Reach reach) {
    std::erase_if(pairs, [&](const Pair& pair) {
      return (pair.a == k || pair.b == k) && pair.touched != step;
    });
    const std::size_t touching = pairs.size();
    for (std::uint32_t b = 0; b < count(); ++b) {
      if (b == k) continue;
      const Pair pair{k, b, image_shift(k, b, cell), -1};
      const double limit = reach(b);
      if (separation(rows[k].grain, rows[b].grain, pair.shift).squaredNorm() >= limit * limit) {
        continue;
      }
      const bool listed = std::any_of(
          pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(touching),
          [&](const Pair& p) { return (p.a == k && p.b == b) || (p.a == b && p.b == k); });
      if (!listed) pairs.push_back(pair);
    }
  }

  /// Marks the rows that stay on the grid at `step`: those in contact, those about to be and those
  /// for which `holds(k)` is true, and whatever is linked to one of them by listed pairs. `holds`
  /// is asked only where the answer matters.
  template <class Holds>
  void mark_held(long step, Holds holds, std::vector<char>& stays) {
    root_.resize(count());
    std::iota(root_.begin(), root_.end(), 0U);
    for (const Pair& pair : pairs) root_[root_of(pair.a)] = root_of(pair.b);
    held_.assign(count(), false);
    for (const Pair& pair : pairs) {
      if (pair.touched == step) held_[root_of(pair.a)] = true;
    }
    for (std::uint32_t k = 0; k < count(); ++k) {
      if (rows[k].fresh || rows[k].base_touched == step) held_[root_of(k)] = true;
    }
    for (std::uint32_t k = 0; k < count(); ++k) {
      if (!held_[root_of(k)] && holds(k)) held_[root_of(k)] = true;
    }
    stays.resize(count());
    for (std::uint32_t k = 0; k < count(); ++k) stays[k] = held_[root_of(k)];
  }

  /// Keeps the rows marked; no pair may join a row that stays to one that goes.
  void keep(const std::vector<char>& stays) {
    std::uint32_t kept = 0;
    for (std::uint32_t k = 0; k < count(); ++k) {
      root_[k] = kept;
      if (!stays[k]) continue;
      if (kept != k) rows[kept] = rows[k];
      ++kept;
    }
    std::erase_if(pairs, [&](const Pair& pair) { return !stays[pair.a]; });
    for (Pair& pair : pairs) {
      pair.a = root_[pair.a];
      pair.b = root_[pair.b];
    }
    rows.resize(kept);
  }

  void clear() {
    rows.clear();
    pairs.clear();
  }

  double elastic_energy(const Physics& physics, const BaseState& base) const {
    double energy = 0;
    for (const Row& row : rows) {
      const double overlap = row.grain.base_overlap(base);
      if (overlap > 0) energy += physics.grain_base.normal.stored_energy(overlap);
    }
    for (const Pair& pair : pairs) {
      const double overlap =
          2 * grain_radius - separation(rows[pair.a].grain, rows[pair.b].grain, pair.shift).norm();
      if (overlap > 0) energy += physics.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

 private:
  typename GridRow<Physics>::Shift image_shift(std::uint32_t a, std::uint32_t b,
                                               const PeriodicCell<D>& cell) const {
    typename GridRow<Physics>::Shift shift;
    for (int c = 0; c < Dimension<D>::lateral; ++c) {
      shift[c] = cell.image_shift(c, rows[b].grain.x[c] - rows[a].grain.x[c]);
    }
    return shift;
  }

  std::uint32_t root_of(std::uint32_t k) {
    while (root_[k] != k) k = root_[k] = root_[root_[k]];
    return k;
  }

  std::vector<std::uint32_t> root_;
  std::vector<char> held_;
};

}  // namespace shakebed::simulator
