#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/dimension.hpp"
#include "simulator/grains/moments.hpp"
#include "simulator/lanes.hpp"

namespace shakebed::simulator {

/// Grains in free flight, as parabolas about one common epoch:
///   x(t) = x0 + v0 t - (g/2) t^2 z,   v(t) = v0 - g t z,   spin constant.
/// With one epoch for all, gravity drops out of every difference of two flights. The epoch is
/// moved along (rebase), so that t stays below a cycle whatever the length of the run. Rows are
/// padded to whole SIMD lanes with absent grains, which stand so far away that they meet nobody.
template <int D, std::size_t S>
class Flights {
 public:
  static constexpr int vertical = Dimension<D>::vertical;
  using SpinRow = Eigen::Matrix<double, static_cast<int>(S), 1>;

  Columns<D> position;             ///< x0
  Columns<D> velocity;             ///< v0
  Columns<S> spin;                 ///< constant
  std::vector<double> valid_from;  ///< a closed contact lasts until then; the flight begins there

  Flights(std::size_t count, double gravity) : count_(count), gravity_(gravity) {
    make_room();
    for (std::size_t i = 0; i < padded(); ++i) remove(i);
  }

  /// The flights named, in that order and without their spins.
  void copy_of(const Flights& other, const std::vector<std::uint32_t>& which) {
    count_ = which.size();
    gravity_ = other.gravity_;
    make_room();
    for (std::size_t k = 0; k < count_; ++k) {
      for (int c = 0; c < D; ++c) {
        position[c][k] = other.position[c][which[k]];
        velocity[c][k] = other.velocity[c][which[k]];
      }
      valid_from[k] = other.valid_from[which[k]];
    }
    for (std::size_t k = count_; k < padded(); ++k) remove(k);
  }

  std::size_t count() const { return count_; }
  std::size_t padded() const { return valid_from.size(); }
  bool present(std::size_t i) const { return aloft_[i] > 0; }
  double gravity() const { return gravity_; }

  Vector<D> position_at(std::size_t i, double t) const {
    Vector<D> x = row(position, i) + t * row(velocity, i);
    x[vertical] -= 0.5 * gravity_ * t * t;
    return x;
  }
  Vector<D> velocity_at(std::size_t i, double t) const {
    Vector<D> v = row(velocity, i);
    v[vertical] -= gravity_ * t;
    return v;
  }

  /// From time t on grain i flies from x with velocity v.
  void set(std::size_t i, const Vector<D>& x, Vector<D> v, double t) {
    v[vertical] += gravity_ * t;
    Vector<D> origin = x - t * v;
    origin[vertical] += 0.5 * gravity_ * t * t;
    forget(i);
    set_row(position, i, origin);
    set_row(velocity, i, v);
    at_epoch_.add(origin[vertical], v);
    valid_from[i] = t;
    aloft_[i] = 1;
  }

  /// Grain i is not in flight.
  void remove(std::size_t i) {
    constexpr double nowhere = 1e18;
    forget(i);
    for (auto& column : position) column[i] = 0;
    for (auto& column : velocity) column[i] = 0;
    position[vertical][i] = nowhere;
    valid_from[i] = 0;
    aloft_[i] = 0;
  }

  /// Moves the epoch by T: what was time T is time 0.
  void rebase(double T) {
    for (int c = 0; c < D; ++c) {
      double* __restrict x = position[c].data();
      const double* __restrict v = velocity[c].data();
      const double fall = c == vertical ? 0.5 * gravity_ * T * T : 0.0;
      for (std::size_t i = 0; i < padded(); ++i) x[i] += T * v[i] - fall;
    }
    double* __restrict v = velocity[vertical].data();
    const double* __restrict aloft = aloft_.data();
    for (std::size_t i = 0; i < padded(); ++i) v[i] -= gravity_ * T * aloft[i];
    for (double& t : valid_from) t -= T;
    // Adding afresh costs as much as all the rest, and rounding piles up slowly.
    constexpr int between_sums = 16;
    at_epoch_ = ++rebased_ % between_sums == 0 ? sums_at_epoch() : moments_at(T);
  }

  /// Of all flights at time t, as their parabolas say (also before `valid_from`).
  Moments<D> moments_at(double t) const { return at_epoch_.after_flight(t, gravity_); }

  /// Largest speed at the epoch. (Absent grains are at rest.)
  double fastest() const {
    Lanes most = 0;
    for (std::size_t i = 0; i < padded(); i += lane_count) {
      Lanes square = 0;
      for (const auto& column : velocity) {
        const Lanes v = load_lanes(&column[i]);
        square += v * v;
      }
      most = std::experimental::max(most, square);
    }
    return std::sqrt(std::experimental::hmax(most));
  }

 private:
  void forget(std::size_t i) {
    if (present(i)) at_epoch_.add(position[vertical][i], row(velocity, i), -1);
  }

  /// Afresh, so that what adding and taking away leaves in rounding does not pile up.
  Moments<D> sums_at_epoch() const {
    Moments<D> sums;
    for (int c = 0; c < D; ++c) {
      const auto [sum, square] = sums_of(velocity[c]);
      sums.velocity[c] = sum;
      sums.square[c] = square;
    }
    const auto [height, count] = sums_in_parts(padded(), [&](std::size_t i) {
      return std::array{aloft_[i] * position[vertical][i], aloft_[i]};
    });
    sums.height = height;
    sums.count = count;
    return sums;
  }

  void make_room() {
    const std::size_t rows = (count_ + lane_count - 1) / lane_count * lane_count;
    resize(position, rows);
    resize(velocity, rows);
    resize(spin, rows);
    valid_from.resize(rows, 0.0);
    aloft_.resize(rows, 0.0);
  }

  std::size_t count_;
  double gravity_;
  std::vector<double> aloft_;  ///< 1 in flight, 0 absent
  Moments<D> at_epoch_;        ///< of those in flight
  int rebased_ = 0;
};

}  // namespace shakebed::simulator
