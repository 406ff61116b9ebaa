#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "files/error.hpp"
#include "simulator/boundary/periodic.hpp"
#include "simulator/grains/grains.hpp"
#include "simulator/grains/random_stream.hpp"

namespace shakebed::simulator {

/// Grains on a loose lattice above the still base (spacing >= 1.05 d, so that none touch), shaken
/// by a random offset that still leaves gaps. They are at rest; settling makes a bed of them.
template <int D, bool TurnsGrains>
Grains<D, TurnsGrains> fill(std::size_t count, const PeriodicCell<D>& cell, std::uint64_t seed) {
  constexpr double least_spacing = 1.05;
  std::array<std::size_t, Dimension<D>::lateral> sites{};
  std::array<double, Dimension<D>::lateral> spacing{};
  std::size_t per_layer = 1;
  for (int c = 0; c < Dimension<D>::lateral; ++c) {
    sites[c] = std::max<std::size_t>(1, static_cast<std::size_t>(cell.width[c] / least_spacing));
    spacing[c] = cell.width[c] / static_cast<double>(sites[c]);
    per_layer *= sites[c];
  }

  RandomStream random(seed, RandomPurpose::filling);
  Grains<D, TurnsGrains> grains;
  grains.resize_to(count);
  constexpr double layer_spacing = 1.1;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t site = i % per_layer;
    for (int c = 0; c < Dimension<D>::lateral; ++c) {
      const double jitter = 0.5 * (spacing[c] - 1) * (2 * random.uniform() - 1);
      grains.position[c][i] =
          (static_cast<double>(site % sites[c]) + 0.5) * spacing[c] + 0.98 * jitter;
      site /= sites[c];
    }
    const double layer = static_cast<double>(i / per_layer);
    grains.position[Dimension<D>::vertical][i] =
        grain_radius + 0.05 + layer_spacing * layer + 0.04 * (2 * random.uniform() - 1);
  }
  return grains;
}

}  // namespace shakebed::simulator
