#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "simulator/grains/sized_grains.hpp"
#include "simulator/motion/column/rows.hpp"

namespace shakebed::simulator {

/// The grains of a bed in rows kept in order of height, so that neighbours in space are neighbours
/// in memory. Behind them stand pairs of rows, far apart, that fill up SIMD vectors and touch
/// nothing: one for each list that is worked on at the same time as others.
struct RowStore {
  std::vector<Four> position;  ///< at step n; fourth lanes are 0
  std::vector<MotionRow> motion;
  std::vector<OwnRow> own;
  /// Blocks of rows write to one of these in turns, those of their own rows and those of rows of
  /// the next block, whose own are in the other.
  std::array<std::vector<PullRow>, 2> pull;
  std::vector<double> radius;
  std::vector<double> mass;
  std::vector<std::uint32_t> grain;  ///< which grain a row holds

  std::size_t count() const { return grain.size(); }

  double effective_mass(std::uint32_t i, std::uint32_t j) const {
    return mass[i] * mass[j] / (mass[i] + mass[j]);
  }

  /// The first row of the pair that fills up a list's vectors.
  std::uint32_t padding(std::size_t list) const {
    return static_cast<std::uint32_t>(count() + 2 * list);
  }

  explicit RowStore(const SizedGrains& start, std::size_t padded_lists = 1) {
    const std::size_t n = start.count();
    const std::size_t room = n + 2 * padded_lists;
    position.assign(room, Four{});
    motion.assign(room, MotionRow{});
    own.assign(room, OwnRow{});
    for (auto& one : pull) one.assign(room, PullRow{});
    radius = start.radius;
    mass = start.mass;
    grain.resize(n);
    std::iota(grain.begin(), grain.end(), 0U);
    constexpr double far_away = 1e6;
    for (std::size_t k = n + 1; k < room; k += 2) position[k][0] = far_away;
    for (std::size_t i = 0; i < n; ++i) {
      const double inverse = 1 / mass[i];
      for (int c = 0; c < 3; ++c) {
        position[i][c] = start.position[c][i];
        motion[i].velocity[c] = own[i].half_velocity[c] = start.velocity[c][i];
        motion[i].rim_velocity[c] = own[i].half_rim[c] = radius[i] * start.spin[c][i];
      }
      own[i].half_velocity[3] = inverse;
      own[i].half_rim[3] = -2.5 * inverse;
    }
  }

  /// The order of rows by height: new row k takes what is now in row order[k].
  std::vector<std::uint32_t> by_height() const {
    std::vector<std::uint32_t> order(count());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double za = position[a][2];
      const double zb = position[b][2];
      return za != zb ? za < zb : grain[a] < grain[b];
    });
    return order;
  }

  /// Of the pulls, the first array.
  void reorder(const std::vector<std::uint32_t>& order) {
    take(position, order);
    take(motion, order);
    take(own, order);
    take(pull[0], order);
    take(radius, order);
    take(mass, order);
    take(grain, order);
  }

  template <class Value>
  static void take(std::vector<Value>& values, const std::vector<std::uint32_t>& order) {
    const std::vector<Value> before = values;
    for (std::size_t k = 0; k < order.size(); ++k) values[k] = before[order[k]];
  }
};

}  // namespace shakebed::simulator
