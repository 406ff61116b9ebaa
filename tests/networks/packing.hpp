#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "fitting/networks/force_law.hpp"
#include "fitting/networks/snapshot.hpp"

// Made-up beds for tests and benchmarks: the size, density and contacts of Sun's, not its physics.
namespace shakebed::tests {

using Random = std::mt19937_64;

inline double uniform(Random& random) {
  return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
}

/// Forces drawn from a law with 0 <= b <= 1, by rejection from exp(-beta f).
std::vector<double> draw(const fitting::networks::ForceLaw& law, std::size_t count, Random& random);

struct PackingOptions {
  std::size_t small_grains = 7600;
  double cylinder_diameter = 12.25;
  double solid_fraction = 0.5;  ///< looser than Sun's, which gives his coordination number of 4
  bool large_grain = true;      ///< of diameter 3.16, near the bottom
  std::size_t flying = 0;       ///< grains 30 d and more above the bed
  int sweeps = 30;              ///< of overlap relaxation
};

/// Grains strewn into a cylinder and pushed apart; whoever still overlaps touches. Forces come from
/// Sun's law, b = 0.68, beta = 1.35, the larger ones at the deeper overlaps.
fitting::networks::Snapshot packing(const PackingOptions& options, std::uint64_t seed);

}  // namespace shakebed::tests
