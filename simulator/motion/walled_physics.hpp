#pragma once

#include <vector>

#include "simulator/boundary/flat_wall.hpp"
#include "simulator/motion/leapfrog.hpp"

namespace shakebed::simulator {

/// A bed between flat walls: its base (the first), a lid, side walls. The whole of them that moves
/// does so along one coordinate.
template <int D, class Tangential>
struct WalledPhysics : BedPhysics<D, Tangential> {
  using Base = BedPhysics<D, Tangential>;
  using Wall = FlatWall<typename Base::ContactLaw>;
  static constexpr bool walled = true;

  WalledPhysics(const Base& bed, std::vector<Wall> all_walls, bool x_is_periodic)
      : Base(bed), walls(std::move(all_walls)), x_periodic(x_is_periodic) {}

  std::vector<Wall> walls;
  bool x_periodic;

  bool periodic(int coordinate) const { return coordinate > 0 || x_periodic; }

  double overlap(const Wall& wall, double coordinate, const BaseState& now) const {
    return grain_radius - wall.inward * (coordinate - wall.at(now.height));
  }
};

}  // namespace shakebed::simulator
