#pragma once

namespace shakebed::simulator {

/// A rigid plane across one coordinate, with grains on one side of it. `Law` is the contact law of
/// grain and wall.
template <class Law>
struct FlatWall {
  int axis;        ///< the coordinate it lies across
  double inward;   ///< +1: grains have larger coordinates than the wall; -1: smaller
  double place;    ///< its coordinate when the base is at its mean height [d]
  bool moves;      ///< with the base, else it stands still
  int drive_axis;  ///< the coordinate along which the base moves
  Law law;

  /// Its coordinate when the base is displaced by `displacement`.
  double at(double displacement) const {
    return moves && axis == drive_axis ? place + displacement : place;
  }
};

}  // namespace shakebed::simulator
