#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace shakebed::simulator {

/// Which pairs of a list each row is part of.
class PairsOfRows {
 public:
  /// `ends(k)` gives the two rows of pair k.
  template <class Ends>
  void list(std::size_t rows, std::size_t pairs, Ends ends) {
    first_.assign(rows + 1, 0);
    for (std::size_t k = 0; k < pairs; ++k) {
      const auto [i, j] = ends(k);
      ++first_[i + 1];
      ++first_[j + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    pairs_.resize(2 * pairs);
    next_ = first_;
    for (std::uint32_t k = 0; k < pairs; ++k) {
      const auto [i, j] = ends(k);
      pairs_[next_[i]++] = k;
      pairs_[next_[j]++] = k;
    }
  }

  /// Gives `visit` the number of each pair that `row` is part of, in rising order.
  template <class Visit>
  void for_pairs_of(std::uint32_t row, Visit visit) const {
    for (auto n = first_[row]; n < first_[row + 1]; ++n) visit(pairs_[n]);
  }

  template <class Archive>
  void archive(Archive& a) {
    a(first_);
    a(pairs_);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> pairs_;
};

}  // namespace shakebed::simulator
