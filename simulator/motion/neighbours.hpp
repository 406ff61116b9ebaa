#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "simulator/boundary/periodic.hpp"
#include "simulator/dimension.hpp"

namespace shakebed::simulator {

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

}  // namespace shakebed::simulator
