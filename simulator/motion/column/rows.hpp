#pragma once

#include <cstdint>

#include "simulator/contact/triple.hpp"
#include "simulator/motion/transposes.hpp"

namespace shakebed::simulator {

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

/// With 0 in the fourth lane: one instruction, where setting a lane is three.
[[gnu::always_inline]] inline Four three_of(const Four& a) {
  using Bits = long long __attribute__((vector_size(32)));
  return reinterpret_cast<Four>(reinterpret_cast<Bits>(a) & Bits{-1, -1, -1, 0});
}

/// Sums over the contacts of a grain; fourth lanes are 0.
struct alignas(64) PullRow {
  Four force;
  Four moment;  ///< sum of n x F_t
};

using LaneTriple = Triple<Lanes>;

/// Rows of four to one SIMD vector per component: component c of row k becomes lane k of out[c].
template <class Simd>
[[gnu::always_inline]] inline void transpose_rows(const Four* d, Triple<Simd>& out) {
  Simd column[4];
  transpose_rows(d, column);
  out = {column[0], column[1], column[2]};
}

/// The way back; fourth lanes become 0.
template <class Simd>
[[gnu::always_inline]] inline void transpose_lanes(const Triple<Simd>& in, Four* d) {
  const Simd column[4] = {in.x, in.y, in.z, Simd(0.0)};
  transpose_lanes(column, d);
}

}  // namespace shakebed::simulator
