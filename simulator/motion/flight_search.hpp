#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "simulator/motion/bins.hpp"
#include "simulator/motion/next_touch.hpp"

namespace shakebed::simulator {

/// Who flies near whom. Beds of a few hundred grains are swept whole, in lanes; in larger ones only
/// the grains of adjacent bins are, so that an event costs the same whatever the bed's width.
template <int D, std::size_t S>
class FlightSearch {
 public:
  FlightSearch(const PeriodicCell<D>& cell, const Flights<D, S>& flights)
      : cell_(cell), flights_(flights), bins_(cell, flights.count()), around_(0, 0) {}

  void enter(std::uint32_t i, const Vector<D>& x) { bins_.enter(i, x); }
  void leave(std::uint32_t i) { bins_.leave(i); }

  /// As next_pair_touch; `recheck` is also due when grain i changes bin.
  NextTouch next_touch(std::uint32_t i, double from) {
    if (!bins_.active()) return next_pair_touch(flights_, cell_, i, from);
    const double start = std::max(from, flights_.valid_from[i]);
    const Vector<D> x = flights_.position_at(i, start);
    bins_.enter(i, x);
    near_.assign(1, i);
    bins_.each_adjacent(i, [&](std::uint32_t j) {
      if (j != i) near_.push_back(j);
    });
    around_.copy_of(flights_, near_);
    auto next = next_pair_touch(around_, cell_, 0, from);
    next.partner = near_[next.partner];
    next.recheck =
        std::min(next.recheck, start + bins_.time_to_leave(i, x, flights_.velocity_at(i, start)));
    return next;
  }

  /// As find_flights_near.
  void find_near(const Vector<D>& point, double t, double reach,
                 std::vector<std::uint32_t>& found) const {
    if (!bins_.active()) {
      find_flights_near(flights_, cell_, point, t, reach, found);
      return;
    }
    found.clear();
    bins_.each_near(point, reach, [&](std::uint32_t j) {
      Vector<D> r = flights_.position_at(j, t) - point;
      for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += cell_.image_shift(c, r[c]);
      if (r.squaredNorm() < reach * reach) found.push_back(j);
    });
  }

 private:
  PeriodicCell<D> cell_;
  const Flights<D, S>& flights_;
  Bins<D> bins_;
  Flights<D, S> around_;
  std::vector<std::uint32_t> near_;
};

}  // namespace shakebed::simulator
