#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "simulator/grains/grains.hpp"

namespace shakebed::simulator {

/// Sums over i < count of the numbers that values(i) gives, each in eight interleaved parts: in
/// order, the machine would wait for every addition; so, it adds in whatever lanes it has, and
/// rounds alike in all of them.
template <class Values>
auto sums_in_parts(std::size_t count, const Values& values) {
  constexpr std::size_t parts = 8;
  constexpr std::size_t numbers = std::tuple_size_v<decltype(values(0))>;
  std::array<std::array<double, parts>, numbers> sums{};
  const auto add = [&](std::size_t i, std::size_t part) {
    const auto here = values(i);
    for (std::size_t n = 0; n < numbers; ++n) sums[n][part] += here[n];
  };
  std::size_t i = 0;
  for (; i + parts <= count; i += parts) {
    for (std::size_t k = 0; k < parts; ++k) add(i + k, k);
  }
  for (std::size_t k = 0; i + k < count; ++k) add(i + k, k);
  std::array<double, numbers> total{};
  for (std::size_t n = 0; n < numbers; ++n) {
    for (const double part : sums[n]) total[n] += part;
  }
  return total;
}

/// Of v and of v^2.
inline std::array<double, 2> sums_of(const std::vector<double>& v) {
  return sums_in_parts(v.size(), [&](std::size_t i) { return std::array{v[i], v[i] * v[i]}; });
}

/// What temperatures and the centre of mass are made of, at one instant: sums over grains.
template <int D>
struct Moments {
  static constexpr int vertical = Dimension<D>::vertical;

  std::array<double, D> velocity{};  ///< sum of v_c [sqrt(g d)]
  std::array<double, D> square{};    ///< sum of v_c^2 [g d]
  double height = 0;                 ///< sum of z [d]
  double count = 0;

  /// One more grain (sign = 1), or one fewer (sign = -1).
  void add(double z, const Vector<D>& v, double sign = 1) {
    for (int c = 0; c < D; ++c) {
      velocity[c] += sign * v[c];
      square[c] += sign * v[c] * v[c];
    }
    height += sign * z;
    count += sign;
  }

  /// Of the same grains after time t in free flight: v_z - g t, z + v_z t - (g/2) t^2.
  Moments after_flight(double t, double gravity) const {
    Moments later = *this;
    const double fall = gravity * t;
    later.height += t * (velocity[vertical] - 0.5 * fall * count);
    later.velocity[vertical] -= fall * count;
    later.square[vertical] -= fall * (2 * velocity[vertical] - fall * count);
    return later;
  }
};

template <int D, bool TurnsGrains>
Moments<D> moments_of(const Grains<D, TurnsGrains>& grains) {
  Moments<D> moments;
  for (int c = 0; c < D; ++c) {
    const auto [sum, square] = sums_of(grains.velocity[c]);
    moments.velocity[c] = sum;
    moments.square[c] = square;
  }
  moments.height = sums_of(grains.position[Moments<D>::vertical])[0];
  moments.count = static_cast<double>(grains.count());
  return moments;
}

}  // namespace shakebed::simulator
