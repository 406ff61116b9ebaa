#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simulator/motion/leapfrog.hpp"

namespace shakebed::simulator {

/// The few grains that are stepped on the global time grid while the others fly: those in contact
/// and those that might touch them before the next regrouping. Steps here equal the uniform
/// engine's to rounding. Which grains belong is the engine's business; this class moves them.
template <class Physics>
class FineContacts {
 public:
  static constexpr int D = Physics::dimension;
  static constexpr int S = Physics::GrainState::spin_columns;
  static constexpr int vertical = Dimension<D>::vertical;
  using SpinRow = Eigen::Matrix<double, S, 1>;

  struct Pair {
    std::uint32_t a;  ///< rows
    std::uint32_t b;
    std::array<double, Dimension<D>::lateral> shift;
    long touched;  ///< the last step at which they touched
  };

  LeapfrogGrains<Physics> grains;
  std::vector<std::uint32_t> id;  ///< grain in row k
  std::vector<double> speed_cap;  ///< no row moves faster before the next regrouping
  std::vector<long> base_touched;
  std::vector<Pair> pairs;
  bool near_base = false;
  long touching = 0;  ///< contacts at the present step
  bool cap_broken = false;

  std::size_t count() const { return id.size(); }

  std::size_t add(std::uint32_t grain, const Vector<D>& x, const Vector<D>& v, const SpinRow& omega,
                  const Physics& physics) {
    const std::size_t k = count();
    id.push_back(grain);
    speed_cap.push_back(0);
    base_touched.push_back(-1);
    grains.resize_to(k + 1);
    grains.set_flying(k, x, v, omega, physics);
    return k;
  }

  /// Keeps only the rows named, in that order.
  void keep(const std::vector<std::uint32_t>& rows) {
    for (std::size_t k = 0; k < rows.size(); ++k) move_row(rows[k], k);
    const std::size_t n = rows.size();
    id.resize(n);
    speed_cap.resize(n);
    base_touched.resize(n);
    grains.resize_to(n);
    pairs.clear();
  }

  /// All pairs of rows within `reach(a, b)` of each other, by nearest image.
  template <class Reach>
  void find_pairs(const PeriodicCell<D>& cell, Reach reach) {
    for (std::uint32_t a = 0; a < count(); ++a) {
      for (std::uint32_t b = a + 1; b < count(); ++b) {
        Pair pair{a, b, {}, -1};
        double rr = 0;
        for (int c = 0; c < D; ++c) {
          double r = grains.position[c][b] - grains.position[c][a];
          if (c < Dimension<D>::lateral) {
            pair.shift[c] = cell.image_shift(c, r);
            r += pair.shift[c];
          }
          rr += r * r;
        }
        const double limit = reach(a, b);
        if (rr < limit * limit) pairs.push_back(pair);
      }
    }
  }

  Vector<D> separation(const Pair& pair) const {
    Vector<D> r;
    for (int c = 0; c < D; ++c) {
      r[c] = grains.position[c][pair.b] - grains.position[c][pair.a];
      if (c < Dimension<D>::lateral) r[c] += pair.shift[c];
    }
    return r;
  }

  /// One step of the grid, arriving at `step` (of the run), at which the base is as given.
  void advance(const Physics& physics, const BaseState& base, long step, EnergyLedger& ledger) {
    grains.kick_drift_predict(physics);
    touching = 0;
    if (near_base) touch_base(physics, base, step, ledger);
    for (auto& pair : pairs) {
      const Vector<D> r = separation(pair);
      const double rr = r.squaredNorm();
      if (rr >= 4 * grain_radius * grain_radius) continue;
      grains.touch_pair(physics, pair.a, pair.b, r, rr, pair.touched != step - 1, ledger);
      pair.touched = step;
      ++touching;
    }
    cap_broken = false;
    for (std::size_t k = 0; k < count(); ++k) {
      if (row(grains.half_velocity, k).squaredNorm() > speed_cap[k] * speed_cap[k]) {
        cap_broken = true;
      }
    }
  }

  double elastic_energy(const Physics& physics, const BaseState& base) const {
    double energy = 0;
    for (std::size_t k = 0; k < count(); ++k) {
      const double overlap = grains.base_overlap(k, base);
      if (overlap > 0) energy += physics.grain_base.normal.stored_energy(overlap);
    }
    for (const auto& pair : pairs) {
      const double overlap = 2 * grain_radius - separation(pair).norm();
      if (overlap > 0) energy += physics.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

 private:
  void touch_base(const Physics& physics, const BaseState& base, long step, EnergyLedger& ledger) {
    for (std::size_t k = 0; k < count(); ++k) {
      const double overlap = grains.base_overlap(k, base);
      if (overlap <= 0) continue;
      grains.touch_base(physics, k, base, overlap, base_touched[k] != step - 1, ledger);
      base_touched[k] = step;
      ++touching;
    }
  }

  void move_row(std::size_t from, std::size_t to) {
    if (from == to) return;
    id[to] = id[from];
    speed_cap[to] = speed_cap[from];
    base_touched[to] = base_touched[from];
    grains.copy_row(to, grains, from);
  }
};

}  // namespace shakebed::simulator
