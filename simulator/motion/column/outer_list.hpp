#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "simulator/motion/column/near_search.hpp"
#include "simulator/motion/column/row_store.hpp"
#include "simulator/motion/pairs_of_rows.hpp"

namespace shakebed::simulator {

/// All pairs of rows whose surfaces are closer than a skin, in rising order of their first row,
/// with each row's own share of them. Serves while no two grains have come closer by the skin since
/// it was built; that the bed moves as a whole does not count.
class OuterList {
 public:
  explicit OuterList(double cylinder_radius) : search_(cylinder_radius) {}

  std::size_t size() const { return size_; }
  /// Rows and a_i + a_j of each pair; behind the last, a vector's width of pairs that never meet.
  const std::uint32_t* i() const { return i_.data(); }
  const std::uint32_t* j() const { return j_.data(); }
  const double* contact_size() const { return contact_size_.data(); }
  double skin() const { return skin_; }
  const std::vector<Four>& built_at() const { return built_at_; }

  /// Gives `visit` the number of each pair that `row` is part of.
  template <class Visit>
  void for_pairs_of(std::uint32_t row, Visit visit) const {
    of_rows_.for_pairs_of(row, visit);
  }

  /// Rows are in order of height.
  void build(const RowStore& rows, double skin) {
    skin_ = skin;
    const std::size_t n = rows.count();
    i_.clear();
    j_.clear();
    double widest = 0;
    for (const double a : rows.radius) widest = std::max(widest, a <= large ? a : 0);
    search_.take_up(rows, 2 * widest + skin,
                    [&](std::size_t i) { return rows.radius[i] <= large; });
    for (std::uint32_t i = 0; i < n; ++i) {
      if (rows.radius[i] > large) {
        pair_with_all(rows, i);
      } else {
        search_.for_near_above(rows, i, skin, [&](std::uint32_t j) { push(i, j); });
      }
    }
    size_ = i_.size();
    for (std::size_t k = 0; k < lane_count; ++k) {
      push(static_cast<std::uint32_t>(n), static_cast<std::uint32_t>(n + 1));
    }
    contact_size_.assign(i_.size(), 1);
    for (std::size_t k = 0; k < size_; ++k) {
      contact_size_[k] = rows.radius[i_[k]] + rows.radius[j_[k]];
    }
    of_rows_.list(n, size_, [&](std::size_t k) { return std::pair{i_[k], j_[k]}; });
    built_at_.resize(n);
    for (std::size_t i = 0; i < n; ++i) built_at_[i] = rows.seen[i].position;
  }

  template <class Archive>
  void archive(Archive& a) {
    a(skin_);
    a(size_);
    a(i_);
    a(j_);
    a(contact_size_);
    of_rows_.archive(a);
    a(built_at_);
  }

 private:
  /// Grains of a larger radius are paired by looking at all others: one reach for all would make
  /// the search among the small ones many times longer.
  static constexpr double large = 0.75;

  void push(std::uint32_t i, std::uint32_t j) {
    i_.push_back(i);
    j_.push_back(j);
  }

  void pair_with_all(const RowStore& rows, std::uint32_t i) {
    for (std::uint32_t j = 0; j < rows.count(); ++j) {
      if (j == i || (rows.radius[j] > large && j < i)) continue;
      const Four r = rows.seen[i].position - rows.seen[j].position;
      const double reach = rows.radius[i] + rows.radius[j] + skin_;
      if (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach) push(i, j);
    }
  }

  NearSearch search_;
  double skin_ = 0;
  std::size_t size_ = 0;
  std::vector<std::uint32_t> i_;
  std::vector<std::uint32_t> j_;
  std::vector<double> contact_size_;
  PairsOfRows of_rows_;
  std::vector<Four> built_at_;
};

}  // namespace shakebed::simulator
