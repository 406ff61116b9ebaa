#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "files/error.hpp"
#include "simulator/boundary/periodic.hpp"
#include "simulator/grains/grains.hpp"
#include "simulator/grains/random_stream.hpp"

namespace shakebed::simulator {

inline constexpr double least_grain_spacing = 1.05;  ///< lateral, of the lattice of fill() [d]
inline constexpr double least_layer_spacing = 1.08;  ///< when a lid is low [d]
inline constexpr double usual_layer_spacing = 1.1;   ///< [d]

inline std::size_t sites_along(double width) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(width / least_grain_spacing));
}

/// Layers in which fill() puts `count` grains.
inline std::size_t filled_layers(std::size_t count, std::span<const double> widths) {
  std::size_t per_layer = 1;
  for (const double width : widths) per_layer *= sites_along(width);
  return (count + per_layer - 1) / per_layer;
}

/// Least height between base and lid that fill() takes [d].
inline double filled_height(std::size_t count, std::span<const double> widths) {
  return 0.1 + least_layer_spacing * static_cast<double>(filled_layers(count, widths));
}

/// Grains on a loose lattice above the still base (spacing >= 1.05 d, so that none touch), shaken
/// by a random offset that still leaves gaps. They are at rest; settling makes a bed of them.
/// A low lid brings the layers closer; without gravity they are spread up to it.
template <int D, bool TurnsGrains>
Grains<D, TurnsGrains> fill(std::size_t count, const PeriodicCell<D>& cell, std::uint64_t seed,
                            double layer_spacing = usual_layer_spacing) {
  std::array<std::size_t, Dimension<D>::lateral> sites{};
  std::array<double, Dimension<D>::lateral> spacing{};
  std::size_t per_layer = 1;
  for (int c = 0; c < Dimension<D>::lateral; ++c) {
    sites[c] = sites_along(cell.width[c]);
    spacing[c] = cell.width[c] / static_cast<double>(sites[c]);
    per_layer *= sites[c];
  }

  RandomStream random(seed, RandomPurpose::filling);
  Grains<D, TurnsGrains> grains;
  grains.resize_to(count);
  const double vertical_jitter = std::min(0.04, 0.4 * (layer_spacing - 1));
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
        grain_radius + 0.05 + layer_spacing * layer + vertical_jitter * (2 * random.uniform() - 1);
  }
  return grains;
}

}  // namespace shakebed::simulator
