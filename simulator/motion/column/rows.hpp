#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "simulator/contact/triple.hpp"
#include "simulator/motion/transposes.hpp"

namespace shakebed::simulator {

/// Velocities of a grain's centre and rim at step n, as others see them; fourth lanes are 0.
struct alignas(64) MotionRow {
  Four velocity;
  Four rim_velocity;  ///< a omega
};

/// What only the integrator needs: velocities at n - 1/2. Fourth lanes: 1/m and -a^2/I = -5/(2 m),
/// as a d(omega)/dt = -(a^2/I) sum of n x F_t.
struct alignas(64) OwnRow {
  Four half_velocity;
  Four half_rim;
};

/// Sums over the contacts of a grain; fourth lanes are 0.
struct alignas(64) PullRow {
  Four force;
  Four moment;  ///< sum of n x F_t
};

/// A row of centre and rim is worked on whole where rims matter and registers are that wide, else
/// by halves.
template <bool turns_grains>
using RowPart = std::conditional_t<turns_grains && lane_count == 8, Eight, Four>;
/// How many parts of a row are worked on.
template <bool turns_grains>
inline constexpr std::size_t parts_of_row = !turns_grains || lane_count == 8 ? 1 : 2;

template <class Part, class Row>
[[gnu::always_inline]] inline Part part_of(const Row& row, std::size_t p) {
  Part part;
  std::memcpy(&part, reinterpret_cast<const char*>(&row) + p * sizeof part, sizeof part);
  return part;
}
template <class Part, class Row>
[[gnu::always_inline]] inline void set_part(Row& row, std::size_t p, const Part& part) {
  std::memcpy(reinterpret_cast<char*>(&row) + p * sizeof part, &part, sizeof part);
}

using FourBits = long long __attribute__((vector_size(32)));
using EightBits = long long __attribute__((vector_size(64)));

/// With 0 in fourth lanes: one instruction, where setting a lane is three.
template <class Part>
[[gnu::always_inline]] inline Part three_of(const Part& a) {
  if constexpr (sizeof(Part) == sizeof(Eight)) {
    return reinterpret_cast<Part>(reinterpret_cast<EightBits>(a) &
                                  EightBits{-1, -1, -1, 0, -1, -1, -1, 0});
  } else {
    return reinterpret_cast<Part>(reinterpret_cast<FourBits>(a) & FourBits{-1, -1, -1, 0});
  }
}

/// The fourth lane of each half in all of its lanes.
template <class Part>
[[gnu::always_inline]] inline Part fourths_of(const Part& a) {
  if constexpr (sizeof(Part) == sizeof(Eight)) {
    return __builtin_shufflevector(a, a, 3, 3, 3, 3, 7, 7, 7, 7);
  } else {
    return __builtin_shufflevector(a, a, 3, 3, 3, 3);
  }
}

template <class Part>
[[gnu::always_inline]] inline Four centre_of(const Part& a) {
  return __builtin_shufflevector(a, a, 0, 1, 2, 3);
}

/// Part p of a row with that of the other grain of a pair, or of the force on it: what belongs to
/// centres is subtracted, what belongs to rims added.
template <class Part>
[[gnu::always_inline]] inline Part with_other(std::size_t p, const Part& a, const Part& b) {
  if constexpr (sizeof(Part) == sizeof(Eight)) {
    constexpr auto sign = std::numeric_limits<long long>::min();
    const EightBits signed_b =
        reinterpret_cast<EightBits>(b) ^ EightBits { sign, sign, sign, sign, 0, 0, 0, 0 };
    return a + reinterpret_cast<Eight>(signed_b);
  } else {
    return p == 0 ? a - b : a + b;
  }
}

using LaneTriple = Triple<Lanes>;

/// Places of rows to one SIMD vector per component.
[[gnu::always_inline]] inline LaneTriple transposed(const Four* places) {
  Lanes column[4];
  transpose_rows(places, column);
  return {column[0], column[1], column[2]};
}

/// What belongs to centres and to rims, one SIMD vector per component: parts[p][k] is part p of the
/// row in lane k.
template <bool turns_grains>
struct RowVectors {
  using Part = RowPart<turns_grains>;
  static constexpr std::size_t parts = parts_of_row<turns_grains>;
  using Parts = Part[parts][lane_count];

  LaneTriple centre;
  LaneTriple rim;

  [[gnu::always_inline]] void take(const Parts& rows) {
    constexpr std::size_t width = sizeof(Part) / sizeof(double);
    Lanes column[parts * width];
    for (std::size_t p = 0; p < parts; ++p) transpose_rows(rows[p], column + p * width);
    centre = {column[0], column[1], column[2]};
    if constexpr (turns_grains) rim = {column[4], column[5], column[6]};
  }

  /// Fourth lanes become 0.
  [[gnu::always_inline]] void give(Parts& rows) const {
    constexpr std::size_t width = sizeof(Part) / sizeof(double);
    Lanes column[parts * width];
    for (auto& one : column) one = Lanes(0.0);
    column[0] = centre.x;
    column[1] = centre.y;
    column[2] = centre.z;
    if constexpr (turns_grains) {
      column[4] = rim.x;
      column[5] = rim.y;
      column[6] = rim.z;
    }
    for (std::size_t p = 0; p < parts; ++p) transpose_lanes(column + p * width, rows[p]);
  }
};

}  // namespace shakebed::simulator
