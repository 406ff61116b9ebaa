#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "files/error.hpp"
#include "simulator/grains/random_stream.hpp"
#include "simulator/grains/sized_grains.hpp"

namespace shakebed::simulator {

/// What a cylinder is filled with. Grain 0 is the large one when there is one.
struct ColumnContents {
  double cylinder_radius = 0;  ///< [d]
  int small_count = 0;
  double smallest = 1;  ///< diameters of small grains, uniform between these [d]
  double largest = 1;
  bool has_large = false;
  double large_diameter = 0;  ///< [d]
  double large_density = 0;   ///< over that of the small grains' material
};

/// Grains at rest on a loose lattice over the base: the large one on the axis, 0.01 d above the
/// base, small ones around and above it, shaken by random offsets that leave gaps.
/// Throws files::Error when not even one small grain finds a place in a layer.
inline SizedGrains fill_column(const ColumnContents& contents, std::uint64_t seed) {
  RandomStream random(seed, RandomPurpose::filling);
  const double size = contents.largest;
  constexpr double jitter = 0.05;
  const double spacing = size + 2.2 * jitter;
  const double room = contents.cylinder_radius - 0.5 * size - 1.1 * jitter;

  std::vector<std::pair<double, double>> sites;
  const int most = room < 0 ? -1 : static_cast<int>(room / spacing) + 1;
  for (int a = -most; a <= most; ++a) {
    for (int b = -most; b <= most; ++b) {
      const double x = a * spacing;
      const double y = b * spacing;
      if (std::hypot(x, y) <= room) sites.emplace_back(x, y);
    }
  }
  if (sites.empty()) {
    throw files::bad_input("container.cylinder.diameter",
                           "no grain of " + std::to_string(size) + " d fits between the walls");
  }

  SizedGrains grains;
  const int first = contents.has_large ? 1 : 0;
  grains.resize_to(static_cast<std::size_t>(contents.small_count + first));
  const double large_radius = contents.has_large ? 0.5 * contents.large_diameter : 0;
  const double large_height = large_radius + 0.01;
  if (contents.has_large) {
    grains.radius[0] = large_radius;
    grains.mass[0] = sphere_mass(contents.large_diameter, contents.large_density);
    grains.position[2][0] = large_height;
  }
  std::size_t next = static_cast<std::size_t>(first);
  for (int layer = 0; next < grains.count(); ++layer) {
    const double height = 0.5 * size + 1.1 * jitter + layer * spacing;
    for (const auto& [x, y] : sites) {
      if (next == grains.count()) break;
      const double clear = large_radius + 0.5 * size + 2 * jitter;
      const double dz = height - large_height;
      if (contents.has_large && x * x + y * y + dz * dz < clear * clear) continue;
      const auto offset = [&] { return jitter * (2 * random.uniform() - 1); };
      set_row(grains.position, next, Vector<3>(x + offset(), y + offset(), height + offset()));
      const double diameter =
          contents.smallest + (contents.largest - contents.smallest) * random.uniform();
      grains.radius[next] = 0.5 * diameter;
      grains.mass[next] = sphere_mass(diameter, 1);
      ++next;
    }
  }
  return grains;
}

}  // namespace shakebed::simulator
