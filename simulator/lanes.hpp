#pragma once

#include <Eigen/Core>
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
inline void store_lanes(double* to, const Lanes& lanes) {
  lanes.copy_to(to, std::experimental::element_aligned);
}

/// min(a, b); a where b is not a number.
inline double smaller(double a, double b) { return b < a ? b : a; }
inline Lanes smaller(const Lanes& a, const Lanes& b) {
  Lanes least = a;
  std::experimental::where(b < a, least) = b;
  return least;
}

/// 0, 1, 2, ...
inline Lanes lane_numbers() {
  return Lanes([](std::size_t k) { return static_cast<double>(k); });
}

}  // namespace shakebed::simulator

/// Eigen's small vectors of lanes.
template <>
struct Eigen::NumTraits<shakebed::simulator::Lanes>
    : Eigen::GenericNumTraits<shakebed::simulator::Lanes> {
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 0 };
};
