#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <type_traits>
#include <vector>

namespace shakebed::simulator {

/// Everything that differs between two dimensions (x, z) and three (x, y, z). The last coordinate
/// is the vertical one. Grains are spheres in both: I = (2/5) m R^2.
template <int D>
struct Dimension {
  static_assert(D == 2 || D == 3);
  static constexpr int coordinates = D;
  static constexpr int lateral = D - 1;
  static constexpr int vertical = D - 1;
  static constexpr int spin_components = D == 2 ? 1 : 3;
};

/// `Number`: double, or lanes of doubles where a law is evaluated for several contacts at once.
template <int D, class Number = double>
using Vector = Eigen::Matrix<Number, D, 1>;
/// Angular velocity or torque: about y in two dimensions.
template <int D, class Number = double>
using Spin = Eigen::Matrix<Number, Dimension<D>::spin_components, 1>;

/// omega x r.
template <int D, class Number = double>
[[gnu::always_inline]] inline Vector<D, Number> cross(
    const std::type_identity_t<Spin<D, Number>>& omega,
    const std::type_identity_t<Vector<D, Number>>& r) {
  if constexpr (D == 2) {
    return {omega[0] * r[1], -omega[0] * r[0]};
  } else {
    return {omega[1] * r[2] - omega[2] * r[1], omega[2] * r[0] - omega[0] * r[2],
            omega[0] * r[1] - omega[1] * r[0]};
  }
}

/// r x f: a torque.
template <int D, class Number = double>
[[gnu::always_inline]] inline Spin<D, Number> moment(
    const std::type_identity_t<Vector<D, Number>>& r,
    const std::type_identity_t<Vector<D, Number>>& f) {
  if constexpr (D == 2) {
    return Spin<D, Number>(r[1] * f[0] - r[0] * f[1]);
  } else {
    return {r[1] * f[2] - r[2] * f[1], r[2] * f[0] - r[0] * f[2], r[0] * f[1] - r[1] * f[0]};
  }
}

/// One contiguous array per coordinate: the layout of every per-grain quantity.
template <std::size_t C>
using Columns = std::array<std::vector<double>, C>;

template <std::size_t C>
inline Eigen::Matrix<double, static_cast<int>(C), 1> row(const Columns<C>& columns, std::size_t i) {
  Eigen::Matrix<double, static_cast<int>(C), 1> v;
  for (std::size_t c = 0; c < C; ++c) v[c] = columns[c][i];
  return v;
}

template <std::size_t C>
inline void set_row(Columns<C>& columns, std::size_t i,
                    const Eigen::Matrix<double, static_cast<int>(C), 1>& v) {
  for (std::size_t c = 0; c < C; ++c) columns[c][i] = v[c];
}

template <std::size_t C>
inline void add_to_row(Columns<C>& columns, std::size_t i,
                       const Eigen::Matrix<double, static_cast<int>(C), 1>& v) {
  for (std::size_t c = 0; c < C; ++c) columns[c][i] += v[c];
}

template <std::size_t C>
inline void resize(Columns<C>& columns, std::size_t count) {
  for (auto& column : columns) column.resize(count, 0.0);
}

}  // namespace shakebed::simulator
