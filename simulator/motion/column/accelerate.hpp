#pragma once

#include "simulator/motion/column/rows.hpp"

namespace shakebed::simulator {

/// dv/dt or a d(omega)/dt of what a part of a row holds; the fourth lanes of velocities say how
/// much a pull changes them.
template <class Part>
[[gnu::always_inline]] inline Part acceleration(const Part& half, const Part& pull,
                                                const Part& field) {
  return fourths_of(half) * pull + field;
}
inline OwnRow accelerations(const OwnRow& own, const PullRow& pull, const Four& field) {
  return {acceleration(own.half_velocity, pull.force, field),
          acceleration(own.half_rim, pull.moment, Four{})};
}

/// Takes the velocities of one row half a step past its place, and those that others see `ahead`
/// past these by the same acceleration; no pulls are left. Gives the centre's velocity, with 0 in
/// the fourth lane.
template <bool turns_grains>
[[gnu::always_inline]] inline Four accelerate(OwnRow& own, MotionRow& motion, PullRow& pull,
                                              const OwnRow& fields, double dt, double ahead) {
  using Part = RowPart<turns_grains>;
  Four v;
  for (std::size_t p = 0; p < parts_of_row<turns_grains>; ++p) {
    const auto half = part_of<Part>(own, p);
    const Part a = acceleration(half, part_of<Part>(pull, p), part_of<Part>(fields, p));
    const Part moved = half + dt * a;
    const Part now = three_of(moved);
    set_part(own, p, moved);
    set_part<Part>(motion, p, now + ahead * a);
    set_part(pull, p, Part{});
    if (p == 0) v = centre_of(now);
  }
  return v;
}

}  // namespace shakebed::simulator
