#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace shakebed::simulator {

/// Rows in order of height, cut into equal blocks one above the other. Their number depends on the
/// bed's size alone, never on the number of threads.
class BlockCuts {
 public:
  explicit BlockCuts(std::size_t rows) : rows_(rows) {
    while (count_ < most && rows_ >= 2 * count_ * least_rows) count_ *= 2;
  }

  std::size_t count() const { return count_; }
  std::uint32_t begin(std::size_t block) const {
    return static_cast<std::uint32_t>((rows_ * block + count_ - 1) / count_);
  }
  std::uint32_t end(std::size_t block) const { return begin(block + 1); }
  std::size_t block_of(std::uint32_t row) const { return row * count_ / rows_; }

  /// Rows below this one are the block's own or those of the next one.
  std::uint32_t end_of_next(std::size_t block) const {
    return end(std::min(block + 1, count_ - 1));
  }

  /// The block that reckons with a pair: the lower one of two neighbours; count() when the rows are
  /// farther apart.
  std::size_t home_of(std::uint32_t i, std::uint32_t j) const {
    const std::size_t low = block_of(std::min(i, j));
    return block_of(std::max(i, j)) - low <= 1 ? low : count_;
  }

 private:
  static constexpr std::size_t most = 8;          // each costs a percent, whatever works on it
  static constexpr std::size_t least_rows = 400;  // some layers, so that few pairs cross a cut

  std::size_t rows_;
  std::size_t count_ = 1;
};

}  // namespace shakebed::simulator
