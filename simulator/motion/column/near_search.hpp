#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <limits>
#include <vector>

#include "simulator/motion/column/row_store.hpp"

namespace shakebed::simulator {

/// Finds which rows lie near each other above a disc, for rows in order of height: the disc is cut
/// into strips at least `reach` wide, each holding its rows from the lowest up, so that those above
/// row i and near it stand one after the other in nine strips.
class NearSearch {
 public:
  explicit NearSearch(double disc_radius) : disc_radius_(disc_radius) {}

  /// Takes up the rows for which `wanted` holds. `reach` is the largest distance asked for.
  template <class Wanted>
  void take_up(const RowStore& rows, double reach, Wanted wanted) {
    reach_ = reach;
    across_ = std::max<std::size_t>(1, static_cast<std::size_t>(2 * disc_radius_ / reach));
    const std::size_t strips = across_ * across_;
    const std::size_t n = rows.count();
    strip_of_.assign(n, nowhere);
    begin_.assign(strips + 1, 0);
    for (std::size_t i = 0; i < n; ++i) {
      if (!wanted(i)) continue;
      strip_of_[i] = strip_at(rows.position[i]);
      ++begin_[strip_of_[i] + 1];
    }
    // Behind each strip a vector's width of rows that are near nothing.
    for (std::size_t s = 0; s < strips; ++s) begin_[s + 1] += begin_[s] + lane_count;
    const std::size_t room = begin_[strips];
    row_.assign(room, std::numeric_limits<std::uint32_t>::max());
    for (auto& column : position_) column.assign(room, far_away);
    radius_.assign(room, 0);
    Cursor next = cursor();
    for (std::size_t i = 0; i < n; ++i) {
      if (strip_of_[i] == nowhere) continue;
      const std::size_t k = next[strip_of_[i]]++;
      row_[k] = static_cast<std::uint32_t>(i);
      for (int c = 0; c < 3; ++c) position_[c][k] = rows.position[i][c];
      radius_[k] = rows.radius[i];
    }
  }

  /// How far rows in rising order have come in each strip.
  using Cursor = std::vector<std::size_t>;
  Cursor cursor() const { return {begin_.begin(), begin_.end() - 1}; }

  /// Room for the rows near any one.
  std::size_t room() const { return row_.size() + lane_count; }

  /// Puts the rows j > i that were taken up and lie within a_i + a_j + skin of row i at `near`, and
  /// gives the place behind the last. To be asked with one cursor for rows i in rising order.
  std::uint32_t* find_near_above(const RowStore& rows, std::uint32_t i, double skin, Cursor& cursor,
                                 std::uint32_t* near) const {
    if (strip_of_[i] == nowhere) return near;
    const std::size_t cx = strip_of_[i] / across_;
    const std::size_t cy = strip_of_[i] % across_;
    for (std::size_t sx = cx == 0 ? 0 : cx - 1; sx <= std::min(cx + 1, across_ - 1); ++sx) {
      for (std::size_t sy = cy == 0 ? 0 : cy - 1; sy <= std::min(cy + 1, across_ - 1); ++sy) {
        const std::size_t strip = sx * across_ + sy;
        near = look_into(cursor[strip], rows.position[i], rows.radius[i] + skin, i, near);
      }
    }
    return near;
  }

 private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  static constexpr double far_away = 1e6;

  std::size_t index_of(double x) const {
    const double cells = static_cast<double>(across_);
    const double at = std::floor((x + disc_radius_) / (2 * disc_radius_) * cells);
    return static_cast<std::size_t>(std::clamp(at, 0.0, cells - 1));
  }
  std::uint32_t strip_at(const Four& x) const {
    return static_cast<std::uint32_t>(index_of(x[0]) * across_ + index_of(x[1]));
  }

  [[gnu::always_inline]] std::uint32_t* look_into(std::size_t& first, const Four& x,
                                                  double own_reach, std::uint32_t i,
                                                  std::uint32_t* near) const {
    while (row_[first] <= i) ++first;
    for (std::size_t k = first; position_[2][k] <= x[2] + reach_; k += lane_count) {
      const Lanes dx = load_lanes(&position_[0][k]) - Lanes(x[0]);
      const Lanes dy = load_lanes(&position_[1][k]) - Lanes(x[1]);
      const Lanes dz = load_lanes(&position_[2][k]) - Lanes(x[2]);
      const Lanes reach = load_lanes(&radius_[k]) + Lanes(own_reach);
      near = put_set_lanes(
          dx * dx + dy * dy + dz * dz < reach * reach, [&](std::size_t q) { return row_[k + q]; },
          near);
    }
    return near;
  }

  double disc_radius_;
  double reach_ = 1;
  std::size_t across_ = 1;
  std::vector<std::uint32_t> strip_of_;
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> row_;
  std::array<std::vector<double>, 3> position_;
  std::vector<double> radius_;
};

}  // namespace shakebed::simulator
