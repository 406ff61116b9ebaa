#pragma once

#include <array>
#include <cmath>

#include "simulator/dimension.hpp"

namespace shakebed::simulator {

/// Periodic in the lateral coordinates, open above.
template <int D>
struct PeriodicCell {
  std::array<double, Dimension<D>::lateral> width;  ///< [d]

  /// What to add to x_j - x_i (coordinate c) to reach the nearest image of j.
  double image_shift(int c, double difference) const {
    return -width[c] * std::nearbyint(difference / width[c]);
  }

  double wrapped(int c, double x) const { return x - width[c] * std::floor(x / width[c]); }

  double narrowest() const {
    double least = width[0];
    for (const double w : width) least = std::min(least, w);
    return least;
  }

  double area() const {
    double product = 1;
    for (const double w : width) product *= w;
    return product;
  }
};

}  // namespace shakebed::simulator
