#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "simulator/crew.hpp"
#include "simulator/motion/column/block_cuts.hpp"
#include "simulator/motion/column/near_search.hpp"
#include "simulator/motion/column/row_store.hpp"
#include "simulator/motion/pairs_of_rows.hpp"

namespace shakebed::simulator {

/// All pairs of rows whose surfaces are closer than a skin, with each row's own share of them: part
/// by part those of the blocks of `cuts`, in rising order of their lower row, and as a last part
/// those whose rows are in blocks apart or belong to large grains. Serves while no two grains have
/// come closer by the skin since it was built; that the bed moves as a whole does not count.
class OuterList {
 public:
  OuterList(double cylinder_radius, const BlockCuts& cuts)
      : search_(cylinder_radius), cuts_(cuts), begin_(cuts.count() + 2, 0) {}

  std::size_t size() const { return begin_.back(); }
  /// The numbers of a part's pairs are [begin(part), end(part)).
  std::size_t begin(std::size_t part) const { return begin_[part]; }
  std::size_t end(std::size_t part) const { return begin_[part + 1]; }
  std::size_t part_of(std::size_t k) const {
    return k >= begin_[cuts_.count()] ? cuts_.count() : cuts_.block_of(std::min(i_[k], j_[k]));
  }

  /// Rows and a_i + a_j of each pair; behind the last, a vector's width of pairs that never meet.
  const std::uint32_t* i() const { return i_.data(); }
  const std::uint32_t* j() const { return j_.data(); }
  const double* contact_size() const { return contact_size_.data(); }
  double skin() const { return skin_; }
  const std::vector<Four>& built_at() const { return built_at_; }

  bool overlaps(const RowStore& rows, std::size_t k) const {
    const Four r = rows.position[i_[k]] - rows.position[j_[k]];
    return contact_size_[k] - std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) > 0;
  }

  static bool is_large(double radius) { return radius > large; }

  /// Gives `visit` the number of each pair that `row` is part of.
  template <class Visit>
  void for_pairs_of(std::uint32_t row, Visit visit) const {
    of_rows_.for_pairs_of(row, visit);
  }

  /// Rows are in order of height.
  void build(const RowStore& rows, double skin, Crew* crew = nullptr) {
    skin_ = skin;
    const std::size_t n = rows.count();
    double widest = 0;
    for (const double a : rows.radius) widest = std::max(widest, is_large(a) ? 0 : a);
    search_.take_up(rows, 2 * widest + skin,
                    [&](std::size_t i) { return !is_large(rows.radius[i]); });
    near_.resize(cuts_.count());
    far_.resize(cuts_.count());
    share(crew, cuts_.count(), [&](std::size_t part) { search_above(rows, part); });
    std::vector<Pair> apart;
    for (const auto& some : far_) apart.insert(apart.end(), some.begin(), some.end());
    for (std::uint32_t i = 0; i < n; ++i) {
      if (is_large(rows.radius[i])) pair_with_all(rows, i, apart);
    }
    for (std::size_t part = 0; part < cuts_.count(); ++part) {
      begin_[part + 1] = begin_[part] + near_[part].size();
    }
    begin_.back() = begin_[cuts_.count()] + apart.size();
    i_.resize(size() + lane_count);
    j_.resize(size() + lane_count);
    contact_size_.resize(size() + lane_count);
    share(crew, cuts_.count(), [&](std::size_t part) { put(rows, near_[part], begin_[part]); });
    put(rows, apart, begin_[cuts_.count()]);
    for (std::size_t k = size(); k < size() + lane_count; ++k) {
      i_[k] = rows.padding(0);
      j_[k] = rows.padding(0) + 1;
      contact_size_[k] = 1;
    }
    of_rows_.list(n, size(), [&](std::size_t k) { return std::pair{i_[k], j_[k]}; });
    built_at_.resize(n);
    for (std::size_t i = 0; i < n; ++i) built_at_[i] = rows.position[i];
  }

  template <class Archive>
  void archive(Archive& a) {
    a(skin_);
    a(begin_);
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

  struct Pair {
    std::uint32_t i;
    std::uint32_t j;
  };

  void search_above(const RowStore& rows, std::size_t part) {
    near_[part].clear();
    far_[part].clear();
    auto cursor = search_.cursor();
    std::vector<std::uint32_t> above(search_.room());
    const std::uint32_t near_end = cuts_.end_of_next(part);
    for (std::uint32_t i = cuts_.begin(part); i < cuts_.end(part); ++i) {
      const std::uint32_t* past_last =
          search_.find_near_above(rows, i, skin_, cursor, above.data());
      for (const std::uint32_t* j = above.data(); j != past_last; ++j) {
        (*j < near_end ? near_ : far_)[part].push_back({i, *j});
      }
    }
  }

  void pair_with_all(const RowStore& rows, std::uint32_t i, std::vector<Pair>& found) const {
    for (std::uint32_t j = 0; j < rows.count(); ++j) {
      if (j == i || (is_large(rows.radius[j]) && j < i)) continue;
      const Four r = rows.position[i] - rows.position[j];
      const double reach = rows.radius[i] + rows.radius[j] + skin_;
      if (r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach) found.push_back({i, j});
    }
  }

  void put(const RowStore& rows, const std::vector<Pair>& pairs, std::size_t first) {
    for (std::size_t n = 0; n < pairs.size(); ++n) {
      const auto [i, j] = pairs[n];
      i_[first + n] = i;
      j_[first + n] = j;
      contact_size_[first + n] = rows.radius[i] + rows.radius[j];
    }
  }

  NearSearch search_;
  BlockCuts cuts_;
  double skin_ = 0;
  std::vector<std::size_t> begin_;  ///< of each part's pairs, and the end of the last
  std::vector<std::vector<Pair>> near_;
  std::vector<std::vector<Pair>> far_;
  std::vector<std::uint32_t> i_;
  std::vector<std::uint32_t> j_;
  std::vector<double> contact_size_;
  PairsOfRows of_rows_;
  std::vector<Four> built_at_;
};

}  // namespace shakebed::simulator
