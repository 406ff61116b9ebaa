#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "simulator/motion/column/row_store.hpp"
#include "simulator/motion/neighbours.hpp"

namespace shakebed::simulator {

/// All pairs of rows whose surfaces are closer than a skin, with each row's own share of them.
/// Serves while no two grains have come closer by the skin since it was built; that the bed moves
/// as a whole does not count.
class OuterList {
 public:
  explicit OuterList(double cylinder_radius)
      : width_(4 * cylinder_radius + 8),
        offset_(0.25 * width_),
        search_(PeriodicCell<3>{{width_, width_}}) {}

  struct Pair {
    std::uint32_t i, j;
  };

  const std::vector<Pair>& pairs() const { return pairs_; }
  double skin() const { return skin_; }
  const std::vector<Four>& built_at() const { return built_at_; }

  template <class Visit>
  void for_pairs_of(std::uint32_t row, Visit visit) const {
    for (std::size_t k = first_[row]; k < first_[row + 1]; ++k) visit(of_row_[k]);
  }

  void build(const RowStore& rows, double skin) {
    skin_ = skin;
    const std::size_t n = rows.count();
    // The search knows periodic cells; this one is so wide that images never meet.
    for (auto& column : position_) column.resize(n);
    double reach = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        position_[c][i] = rows.seen[i].position[c] + (c < 2 ? offset_ : 0);
      }
      if (rows.radius[i] <= large) reach = std::max(reach, 2 * rows.radius[i] + skin);
    }
    search_.find(position_, reach, near_);
    pairs_.clear();
    for (const auto& pair : near_) {
      if (rows.radius[pair.i] > large || rows.radius[pair.j] > large) continue;
      keep_if_near(rows, std::min(pair.i, pair.j), std::max(pair.i, pair.j));
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (rows.radius[i] <= large) continue;
      for (std::uint32_t j = 0; j < n; ++j) {
        if (j == i || (rows.radius[j] > large && j < i)) continue;
        keep_if_near(rows, i, j);
      }
    }
    sort_pairs(n);
    list_by_row(n);
    built_at_.resize(n);
    for (std::size_t i = 0; i < n; ++i) built_at_[i] = rows.seen[i].position;
  }

  template <class Archive>
  void archive(Archive& a) {
    a(skin_);
    a(pairs_);
    a(first_);
    a(of_row_);
    a(built_at_);
  }

 private:
  /// Grains of a larger radius are paired by looking at all others: one reach for all would make
  /// the search among the small ones many times longer.
  static constexpr double large = 0.75;

  void keep_if_near(const RowStore& rows, std::uint32_t i, std::uint32_t j) {
    const Four r = rows.seen[i].position - rows.seen[j].position;
    const double reach = rows.radius[i] + rows.radius[j] + skin_;
    if (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach) pairs_.push_back({i, j});
  }

  /// In rising order of i, then j: by counting, as i's are many and each has few.
  void sort_pairs(std::size_t n) {
    first_.assign(n + 1, 0);
    for (const auto& pair : pairs_) ++first_[pair.i + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    unsorted_.swap(pairs_);
    pairs_.resize(unsorted_.size());
    next_ = first_;
    for (const auto& pair : unsorted_) pairs_[next_[pair.i]++] = pair;
    const auto begin = pairs_.begin();
    for (std::size_t i = 0; i < n; ++i) {
      std::sort(begin + first_[i], begin + first_[i + 1],
                [](const Pair& a, const Pair& b) { return a.j < b.j; });
    }
  }

  void list_by_row(std::size_t n) {
    first_.assign(n + 1, 0);
    for (const auto& pair : pairs_) {
      ++first_[pair.i + 1];
      ++first_[pair.j + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    of_row_.resize(2 * pairs_.size());
    next_ = first_;
    for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
      of_row_[next_[pairs_[k].i]++] = k;
      of_row_[next_[pairs_[k].j]++] = k;
    }
  }

  double width_;
  double offset_;
  NeighbourSearch<3> search_;
  double skin_ = 0;
  Columns<3> position_;
  std::vector<NeighbourPair<3>> near_;
  std::vector<Pair> pairs_;
  std::vector<Pair> unsorted_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> of_row_;
  std::vector<Four> built_at_;
};

}  // namespace shakebed::simulator
