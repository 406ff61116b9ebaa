#pragma once

#include <cstdint>
#include <experimental/simd>

#include "simulator/contact/triple.hpp"
#include "simulator/lanes.hpp"

namespace shakebed::simulator {

using Four = double __attribute__((vector_size(32)));

/// What others see of a grain at step n; fourth lanes are 0.
struct alignas(32) SeenRow {
  Four position;
  Four velocity;
  Four rim_velocity;  ///< a omega
};

/// What only the integrator needs: velocities at n - 1/2. Fourth lanes: 1/m and a^2/I = 5/(2 m).
struct alignas(64) OwnRow {
  Four half_velocity;
  Four half_rim;
};

/// Sums over the contacts of a grain.
struct alignas(64) PullRow {
  Four force;
  Four moment;  ///< sum of n x F_t
};

using LaneTriple = Triple<Lanes>;

/// Eight doubles as two rows of four beside each other.
using Eight = double __attribute__((vector_size(64)));

/// Rows of four to one SIMD vector per component: component c of row k becomes lane k of out[c].
template <class Simd>
[[gnu::always_inline]] inline void transpose_rows(const Four* d, Triple<Simd>& out) {
  if constexpr (Simd::size() == 8) {
    const Eight a0 = __builtin_shufflevector(d[0], d[4], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight a1 = __builtin_shufflevector(d[1], d[5], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight a2 = __builtin_shufflevector(d[2], d[6], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight a3 = __builtin_shufflevector(d[3], d[7], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight t0 = __builtin_shufflevector(a0, a1, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t1 = __builtin_shufflevector(a0, a1, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight t2 = __builtin_shufflevector(a2, a3, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t3 = __builtin_shufflevector(a2, a3, 1, 9, 3, 11, 5, 13, 7, 15);
    out.x = Simd(__builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13));
    out.y = Simd(__builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13));
    out.z = Simd(__builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15));
  } else if constexpr (Simd::size() == 4) {
    const Four t0 = __builtin_shufflevector(d[0], d[1], 0, 4, 2, 6);
    const Four t1 = __builtin_shufflevector(d[0], d[1], 1, 5, 3, 7);
    const Four t2 = __builtin_shufflevector(d[2], d[3], 0, 4, 2, 6);
    const Four t3 = __builtin_shufflevector(d[2], d[3], 1, 5, 3, 7);
    out.x = Simd(__builtin_shufflevector(t0, t2, 0, 1, 4, 5));
    out.y = Simd(__builtin_shufflevector(t1, t3, 0, 1, 4, 5));
    out.z = Simd(__builtin_shufflevector(t0, t2, 2, 3, 6, 7));
  } else {
    out.x = Simd([&](std::size_t k) { return d[k][0]; });
    out.y = Simd([&](std::size_t k) { return d[k][1]; });
    out.z = Simd([&](std::size_t k) { return d[k][2]; });
  }
}

/// The way back; fourth lanes become 0.
template <class Simd>
[[gnu::always_inline]] inline void transpose_lanes(const Triple<Simd>& in, Four* d) {
  if constexpr (Simd::size() == 8) {
    const auto x = static_cast<Eight>(in.x);
    const auto y = static_cast<Eight>(in.y);
    const auto z = static_cast<Eight>(in.z);
    const Eight zero{};
    const Eight t0 = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t1 = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight t2 = __builtin_shufflevector(z, zero, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t3 = __builtin_shufflevector(z, zero, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight rows[4] = {__builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15),
                           __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15)};
    for (std::size_t k = 0; k < 4; ++k) {
      d[k] = __builtin_shufflevector(rows[k], rows[k], 0, 1, 2, 3);
      d[k + 4] = __builtin_shufflevector(rows[k], rows[k], 4, 5, 6, 7);
    }
  } else if constexpr (Simd::size() == 4) {
    const auto x = static_cast<Four>(in.x);
    const auto y = static_cast<Four>(in.y);
    const auto z = static_cast<Four>(in.z);
    const Four zero{};
    const Four t0 = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    const Four t1 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Four t2 = __builtin_shufflevector(z, zero, 0, 4, 2, 6);
    const Four t3 = __builtin_shufflevector(z, zero, 1, 5, 3, 7);
    d[0] = __builtin_shufflevector(t0, t2, 0, 1, 4, 5);
    d[1] = __builtin_shufflevector(t1, t3, 0, 1, 4, 5);
    d[2] = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
    d[3] = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
  } else {
    for (std::size_t k = 0; k < Simd::size(); ++k) d[k] = Four{in.x[k], in.y[k], in.z[k], 0};
  }
}

}  // namespace shakebed::simulator
