#pragma once

#include <cstdint>
#include <vector>

#include "simulator/contact/triple.hpp"

namespace shakebed::simulator {

/// The partners of a contact that are not grains.
inline constexpr std::int32_t base_partner = -1;
inline constexpr std::int32_t side_partner = -2;

/// One contact at one instant. For j >= 0, i < j. Forces are those on grain i.
struct ColumnContact {
  std::int32_t i;
  std::int32_t j;                   ///< or base_partner, side_partner
  double overlap;                   ///< [d]
  double normal_force;              ///< F_n [m g], negative where the dashpot pulls
  Triple<double> normal;            ///< from j to i
  Triple<double> tangential_force;  ///< [m g]
  Triple<double> memory;            ///< u of a tangential spring [d]; 0 where the law has none
};

/// What a contact remembers when a bed is put down and taken up again.
struct ContactMemory {
  std::int32_t i;
  std::int32_t j;
  Triple<double> u;  ///< as seen from i
};

/// Sums of the forces that grains put on base and side wall [m g].
struct WallForces {
  double base_vertical = 0;  ///< up is positive: a resting bed pushes the base down
  double side_vertical = 0;
  double side_normal = 0;  ///< sum of magnitudes, outwards
};

struct ContactCounters {
  long pair_steps = 0;  ///< steps spent in contact, summed over pairs of grains
  long wall_steps = 0;  ///< the same with base and side wall
  double largest_overlap = 0;
};

}  // namespace shakebed::simulator
