#pragma once

#include <cstddef>
#include <experimental/simd>

namespace shakebed::simulator {

/// As many doubles as the machine handles at once. What is computed per lane, and minima over
/// lanes, do not depend on their number; sums over lanes would, and are not taken.
using Lanes = std::experimental::native_simd<double>;
using LaneMask = Lanes::mask_type;
inline constexpr std::size_t lane_count = Lanes::size();

inline Lanes load_lanes(const double* from) {
  return Lanes(from, std::experimental::element_aligned);
}

/// 0, 1, 2, ...
inline Lanes lane_numbers() {
  return Lanes([](std::size_t k) { return static_cast<double>(k); });
}

}  // namespace shakebed::simulator
