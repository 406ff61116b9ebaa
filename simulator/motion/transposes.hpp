#pragma once

#include <algorithm>
#include <cstddef>

#include "simulator/lanes.hpp"

// Short rows of numbers, one for each lane, to SIMD vectors, one for each number, and back.
namespace shakebed::simulator {

using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
/// Two rows of four beside each other, or four rows of two.
using Eight = double __attribute__((vector_size(64)));

[[gnu::always_inline]] inline Four beside(const Two& a, const Two& b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}

/// Component c of row k becomes lane k of out[c].
template <class Simd>
[[gnu::always_inline]] inline void transpose_rows(const Four* d, Simd* out) {
  if constexpr (Simd::size() == 8) {
    const Eight a0 = __builtin_shufflevector(d[0], d[4], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight a1 = __builtin_shufflevector(d[1], d[5], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight a2 = __builtin_shufflevector(d[2], d[6], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight a3 = __builtin_shufflevector(d[3], d[7], 0, 1, 2, 3, 4, 5, 6, 7);
    const Eight t0 = __builtin_shufflevector(a0, a1, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t1 = __builtin_shufflevector(a0, a1, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight t2 = __builtin_shufflevector(a2, a3, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t3 = __builtin_shufflevector(a2, a3, 1, 9, 3, 11, 5, 13, 7, 15);
    out[0] = Simd(__builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13));
    out[1] = Simd(__builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13));
    out[2] = Simd(__builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15));
    out[3] = Simd(__builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15));
  } else if constexpr (Simd::size() == 4) {
    const Four t0 = __builtin_shufflevector(d[0], d[1], 0, 4, 2, 6);
    const Four t1 = __builtin_shufflevector(d[0], d[1], 1, 5, 3, 7);
    const Four t2 = __builtin_shufflevector(d[2], d[3], 0, 4, 2, 6);
    const Four t3 = __builtin_shufflevector(d[2], d[3], 1, 5, 3, 7);
    out[0] = Simd(__builtin_shufflevector(t0, t2, 0, 1, 4, 5));
    out[1] = Simd(__builtin_shufflevector(t1, t3, 0, 1, 4, 5));
    out[2] = Simd(__builtin_shufflevector(t0, t2, 2, 3, 6, 7));
    out[3] = Simd(__builtin_shufflevector(t1, t3, 2, 3, 6, 7));
  } else {
    for (int c = 0; c < 4; ++c) out[c] = Simd([&](std::size_t k) { return d[k][c]; });
  }
}

/// The same of rows of two.
template <class Simd>
[[gnu::always_inline]] inline void transpose_rows(const Two* d, Simd* out) {
  if constexpr (Simd::size() == 8) {
    const Eight a = __builtin_shufflevector(beside(d[0], d[1]), beside(d[2], d[3]),  //
                                            0, 1, 2, 3, 4, 5, 6, 7);
    const Eight b = __builtin_shufflevector(beside(d[4], d[5]), beside(d[6], d[7]),  //
                                            0, 1, 2, 3, 4, 5, 6, 7);
    out[0] = Simd(__builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14));
    out[1] = Simd(__builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15));
  } else if constexpr (Simd::size() == 4) {
    const Four a = beside(d[0], d[1]);
    const Four b = beside(d[2], d[3]);
    out[0] = Simd(__builtin_shufflevector(a, b, 0, 2, 4, 6));
    out[1] = Simd(__builtin_shufflevector(a, b, 1, 3, 5, 7));
  } else {
    for (int c = 0; c < 2; ++c) out[c] = Simd([&](std::size_t k) { return d[k][c]; });
  }
}

/// Of rows in pairs, each in one register, components c and c + 2 of either half.
template <class Simd>
[[gnu::always_inline]] inline void columns_of_pairs(const Eight* pair, Simd* out) {
  const Eight a = __builtin_shufflevector(pair[0], pair[1], 0, 1, 8, 9, 4, 5, 12, 13);
  const Eight b = __builtin_shufflevector(pair[2], pair[3], 0, 1, 8, 9, 4, 5, 12, 13);
  const Eight c = __builtin_shufflevector(pair[0], pair[1], 2, 3, 10, 11, 6, 7, 14, 15);
  const Eight e = __builtin_shufflevector(pair[2], pair[3], 2, 3, 10, 11, 6, 7, 14, 15);
  out[0] = Simd(__builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11));
  out[2] = Simd(__builtin_shufflevector(c, e, 0, 1, 2, 3, 8, 9, 10, 11));
  out[4] = Simd(__builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15));
  out[6] = Simd(__builtin_shufflevector(c, e, 4, 5, 6, 7, 12, 13, 14, 15));
}

/// The same of rows of eight, for eight lanes.
template <class Simd>
[[gnu::always_inline]] inline void transpose_rows(const Eight* d, Simd* out) {
  static_assert(Simd::size() == 8);
  Eight even[4], odd[4];  // components of two rows
  for (std::size_t k = 0; k < 4; ++k) {
    even[k] = __builtin_shufflevector(d[2 * k], d[2 * k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    odd[k] = __builtin_shufflevector(d[2 * k], d[2 * k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  columns_of_pairs(even, out);
  columns_of_pairs(odd, out + 1);
}

/// The way back: lane k of in[c] becomes component c of row k.
template <class Simd>
[[gnu::always_inline]] inline void transpose_lanes(const Simd* in, Four* d) {
  if constexpr (Simd::size() == 8) {
    const auto x = static_cast<Eight>(in[0]);
    const auto y = static_cast<Eight>(in[1]);
    const auto z = static_cast<Eight>(in[2]);
    const auto w = static_cast<Eight>(in[3]);
    const Eight t0 = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t1 = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight t2 = __builtin_shufflevector(z, w, 0, 8, 2, 10, 4, 12, 6, 14);
    const Eight t3 = __builtin_shufflevector(z, w, 1, 9, 3, 11, 5, 13, 7, 15);
    const Eight rows[4] = {__builtin_shufflevector(t0, t2, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(t1, t3, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(t0, t2, 2, 3, 10, 11, 6, 7, 14, 15),
                           __builtin_shufflevector(t1, t3, 2, 3, 10, 11, 6, 7, 14, 15)};
    for (std::size_t k = 0; k < 4; ++k) {
      d[k] = __builtin_shufflevector(rows[k], rows[k], 0, 1, 2, 3);
      d[k + 4] = __builtin_shufflevector(rows[k], rows[k], 4, 5, 6, 7);
    }
  } else if constexpr (Simd::size() == 4) {
    const auto x = static_cast<Four>(in[0]);
    const auto y = static_cast<Four>(in[1]);
    const auto z = static_cast<Four>(in[2]);
    const auto w = static_cast<Four>(in[3]);
    const Four t0 = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    const Four t1 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Four t2 = __builtin_shufflevector(z, w, 0, 4, 2, 6);
    const Four t3 = __builtin_shufflevector(z, w, 1, 5, 3, 7);
    d[0] = __builtin_shufflevector(t0, t2, 0, 1, 4, 5);
    d[1] = __builtin_shufflevector(t1, t3, 0, 1, 4, 5);
    d[2] = __builtin_shufflevector(t0, t2, 2, 3, 6, 7);
    d[3] = __builtin_shufflevector(t1, t3, 2, 3, 6, 7);
  } else {
    for (std::size_t k = 0; k < Simd::size(); ++k)
      d[k] = Four{in[0][k], in[1][k], in[2][k], in[3][k]};
  }
}

/// The same to rows of eight: the transpose of a square is its own way back.
template <class Simd>
[[gnu::always_inline]] inline void transpose_lanes(const Simd* in, Eight* d) {
  static_assert(Simd::size() == 8);
  Eight columns[8];
  for (std::size_t c = 0; c < 8; ++c) columns[c] = static_cast<Eight>(in[c]);
  Simd rows[8];
  transpose_rows(columns, rows);
  for (std::size_t k = 0; k < 8; ++k) d[k] = static_cast<Eight>(rows[k]);
}

/// The same to rows of two.
template <class Simd>
[[gnu::always_inline]] inline void transpose_lanes(const Simd* in, Two* d) {
  const auto set = [&](std::size_t k, const Four& pair) {
    d[k] = __builtin_shufflevector(pair, pair, 0, 1);
    d[k + 1] = __builtin_shufflevector(pair, pair, 2, 3);
  };
  if constexpr (Simd::size() == 8) {
    const auto x = static_cast<Eight>(in[0]);
    const auto y = static_cast<Eight>(in[1]);
    const Eight a = __builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11);
    const Eight b = __builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15);
    set(0, __builtin_shufflevector(a, a, 0, 1, 2, 3));
    set(2, __builtin_shufflevector(a, a, 4, 5, 6, 7));
    set(4, __builtin_shufflevector(b, b, 0, 1, 2, 3));
    set(6, __builtin_shufflevector(b, b, 4, 5, 6, 7));
  } else if constexpr (Simd::size() == 4) {
    const auto x = static_cast<Four>(in[0]);
    const auto y = static_cast<Four>(in[1]);
    set(0, __builtin_shufflevector(x, y, 0, 4, 1, 5));
    set(2, __builtin_shufflevector(x, y, 2, 6, 3, 7));
  } else {
    for (std::size_t k = 0; k < Simd::size(); ++k) d[k] = Two{in[0][k], in[1][k]};
  }
}

}  // namespace shakebed::simulator
