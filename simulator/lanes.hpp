#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <vector>

namespace shakebed::simulator {

/// As many doubles as the machine handles at once. What is computed per lane, and minima over
/// lanes, do not depend on their number; sums over lanes would, and are not taken.
using Lanes = std::experimental::native_simd<double>;
using LaneMask = Lanes::mask_type;
inline constexpr std::size_t lane_count = Lanes::size();

/// One number in a register of its own kind. The compiler packs neighbouring doubles of small
/// vectors into registers and unpacks them again, which costs more than a contact's arithmetic.
using Lane = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 2>>;

inline Lanes load_lanes(const double* from) {
  return Lanes(from, std::experimental::element_aligned);
}
inline void store_lanes(double* to, const Lanes& lanes) {
  lanes.copy_to(to, std::experimental::element_aligned);
}

/// Adds from + q for each lane q that is set among the first `count`, in rising order. For lanes
/// that are seldom set.
[[gnu::always_inline]] inline void list_set_lanes(const LaneMask& set, std::size_t from,
                                                  std::size_t count,
                                                  std::vector<std::uint32_t>& found) {
  for (std::size_t q = 0; q < std::min(lane_count, count); ++q) {
    if (set[q]) found.push_back(static_cast<std::uint32_t>(from + q));
  }
}

/// Puts value_of(q) of each lane q that is set at `out`, in rising order, and gives the place
/// behind the last; writes up to lane_count places. Without branches, as which lanes are set is
/// anybody's guess.
template <class ValueOf>
[[gnu::always_inline]] inline std::uint32_t* put_set_lanes(const LaneMask& set, ValueOf value_of,
                                                           std::uint32_t* out) {
  for (std::size_t q = 0; q < lane_count; ++q) {
    *out = value_of(q);
    out += set[q] ? 1 : 0;
  }
  return out;
}

/// min(a, b); a where b is not a number.
inline double smaller(double a, double b) { return b < a ? b : a; }
template <class Abi>
inline std::experimental::simd<double, Abi> smaller(const std::experimental::simd<double, Abi>& a,
                                                    const std::experimental::simd<double, Abi>& b) {
  auto least = a;
  std::experimental::where(b < a, least) = b;
  return least;
}

}  // namespace shakebed::simulator

/// Eigen's small vectors of lanes.
template <class Abi>
struct Eigen::NumTraits<std::experimental::simd<double, Abi>>
    : Eigen::GenericNumTraits<std::experimental::simd<double, Abi>> {
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 0 };
};
