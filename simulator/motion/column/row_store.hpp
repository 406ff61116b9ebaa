#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "simulator/grains/sized_grains.hpp"
#include "simulator/motion/column/rows.hpp"

namespace shakebed::simulator {

/// The grains of a bed in rows kept in order of height, so that neighbours in space are neighbours
/// in memory. Two more rows, far apart, fill up SIMD vectors and touch nothing.
struct RowStore {
  std::vector<SeenRow> seen;
  std::vector<OwnRow> own;
  std::vector<PullRow> pull;
  std::vector<double> radius;
  std::vector<double> mass;
  std::vector<std::uint32_t> grain;  ///< which grain a row holds

  std::size_t count() const { return grain.size(); }

  explicit RowStore(const SizedGrains& start) {
    const std::size_t n = start.count();
    seen.assign(n + 2, SeenRow{});
    own.assign(n + 2, OwnRow{});
    pull.assign(n + 2, PullRow{});
    radius = start.radius;
    mass = start.mass;
    grain.resize(n);
    std::iota(grain.begin(), grain.end(), 0U);
    constexpr double far_away = 1e6;
    seen[n + 1].position[0] = far_away;
    for (std::size_t i = 0; i < n; ++i) {
      const double inverse = 1 / mass[i];
      for (int c = 0; c < 3; ++c) {
        seen[i].position[c] = start.position[c][i];
        seen[i].velocity[c] = own[i].half_velocity[c] = start.velocity[c][i];
        seen[i].rim_velocity[c] = own[i].half_rim[c] = radius[i] * start.spin[c][i];
      }
      own[i].half_velocity[3] = inverse;
      own[i].half_rim[3] = 2.5 * inverse;
    }
  }

  /// The order of rows by height: new row k takes what is now in row order[k].
  std::vector<std::uint32_t> by_height() const {
    std::vector<std::uint32_t> order(count());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double za = seen[a].position[2];
      const double zb = seen[b].position[2];
      return za != zb ? za < zb : grain[a] < grain[b];
    });
    return order;
  }

  void reorder(const std::vector<std::uint32_t>& order) {
    take(seen, order);
    take(own, order);
    take(pull, order);
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
