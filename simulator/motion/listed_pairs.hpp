#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "simulator/lanes.hpp"
#include "simulator/motion/neighbours.hpp"

namespace shakebed::simulator {

/// A pair of rows with its own copy of what the outer list knows.
template <int D>
struct alignas(16) ListedPair {
  std::array<double, Dimension<D>::lateral> shift;  ///< takes x_j - x_i to the image meant
  std::uint32_t at_i;                               ///< of the rows, in bytes; see row_at()
  std::uint32_t at_j;
  std::uint32_t k;  ///< in the outer list
};

/// The row that begins `bytes` behind the first: to multiply a number by the size of a row costs as
/// much as to load its velocity.
template <class Row>
[[gnu::always_inline]] inline Row& row_at(Row* rows, std::uint32_t bytes) {
  using Byte = std::conditional_t<std::is_const_v<Row>, const std::byte, std::byte>;
  return *reinterpret_cast<Row*>(reinterpret_cast<Byte*>(rows) + bytes);
}

/// A list of pairs. Behind the last one it holds, up to a whole vector, pairs that are far apart.
template <int D>
class ListedPairs {
 public:
  std::size_t size() const { return size_; }
  const ListedPair<D>& operator[](std::size_t n) const { return pairs_[n]; }
  const ListedPair<D>* begin() const { return pairs_.data(); }
  const ListedPair<D>* end() const { return pairs_.data() + size_; }

  void clear() {
    pairs_.clear();
    size_ = 0;
  }
  void add(const ListedPair<D>& pair) {
    if (size_ == pairs_.size()) pairs_.resize(size_ + lane_count, far_apart());
    pairs_[size_++] = pair;
  }
  /// Moves the n-th pair to another list; the last one takes its place.
  void move_to(ListedPairs& other, std::size_t n) {
    other.add(pairs_[n]);
    pairs_[n] = pairs_[--size_];
    pairs_[size_] = far_apart();
  }

 private:
  static ListedPair<D> far_apart() {
    ListedPair<D> pair{};
    pair.shift.fill(1e6);
    return pair;
  }

  std::vector<ListedPair<D>> pairs_;
  std::size_t size_ = 0;
};

}  // namespace shakebed::simulator
