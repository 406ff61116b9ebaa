#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "simulator/motion/grid_row.hpp"
#include "simulator/motion/may_meet.hpp"
#include "simulator/motion/neighbours.hpp"

namespace shakebed::simulator {

/// What rows promise for a window: to have the velocity of a free flight, give or take a width.
template <class Physics>
class DensePromises {
 public:
  static constexpr int D = Physics::dimension;
  using Row = GridRow<Physics>;

  /// `least_width` is that of a row without contacts.
  DensePromises(std::size_t rows, double least_width)
      : of_(rows), widths_(rows, least_width), least_width_(least_width) {}

  double width(std::uint32_t i) const { return of_[i].width; }
  /// Speed and width of a promise, the largest of all.
  double fastest() const { return fastest_; }

  /// A new window; no contact is known yet.
  void begin_window() {
    fallen_.fill(0);
    fastest_ = 0;
    std::fill(widths_.begin(), widths_.end(), least_width_);
  }
  /// Grains in contact may change their velocities by as much as their contacts close.
  void note_contact(const std::vector<Row>& rows, std::uint32_t i, std::uint32_t j) {
    const double speed = (rows[i].half_velocity() - rows[j].half_velocity()).norm();
    widths_[i] = std::max(widths_[i], speed + least_width_);
    widths_[j] = std::max(widths_[j], speed + least_width_);
  }
  void promise_all(const std::vector<Row>& rows) {
    for (std::uint32_t i = 0; i < rows.size(); ++i) promise(rows[i], i, widths_[i]);
  }

  /// Gravity added `change` to all velocities.
  void note_fall(double change) { fallen_[vertical] += change; }

  bool broken(const Row& row, std::uint32_t i) const {
    const Promise& promise = of_[i];
    auto off = Row::place(row.half.data()) - Row::place(promise.velocity.data()) -
               Row::place(fallen_.data());
    off *= off;
    double square = 0;
    for (int c = 0; c < D; ++c) square += off[c];
    return square > promise.width_squared;
  }
  /// A wider promise from now on.
  void renew(const Row& row, std::uint32_t i) { promise(row, i, 2 * of_[i].width + least_width_); }

  /// Whether the rows of a pair, r apart (from i to j), may meet within `left`.
  bool let_meet(const NeighbourPair<D>& pair, const Vector<D>& r, double left) const {
    const Promise& a = of_[pair.i];
    const Promise& b = of_[pair.j];
    Vector<D> w;
    for (int c = 0; c < D; ++c) w[c] = b.velocity[c] - a.velocity[c];
    return may_meet(r.squaredNorm(), r.dot(w), w.squaredNorm(), 2 * grain_radius, a.width + b.width,
                    left);
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  struct Promise {
    /// But for what gravity adds since the window's beginning; what lies behind is padding.
    alignas(Row::room * sizeof(double)) std::array<double, Row::room> velocity;
    double width;
    double width_squared;
  };

  void promise(const Row& row, std::uint32_t i, double width) {
    Promise& promise = of_[i];
    std::copy_n(row.half.begin(), Row::room, promise.velocity.begin());
    promise.velocity[vertical] -= fallen_[vertical];
    promise.width = width;
    promise.width_squared = width * width;
    fastest_ = std::max(fastest_, std::sqrt(row.half_speed_squared()) + width);
  }

  std::vector<Promise> of_;
  std::vector<double> widths_;
  double least_width_;
  /// What gravity added to velocities since the window's beginning.
  alignas(Row::room * sizeof(double)) std::array<double, Row::room> fallen_{};
  double fastest_ = 0;
};

}  // namespace shakebed::simulator
