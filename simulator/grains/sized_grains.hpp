#pragma once

#include <cstdint>
#include <vector>

#include "simulator/grains/grains.hpp"

namespace shakebed::simulator {

/// Spheres of several sizes and densities at one instant, in three dimensions. Rows keep their
/// grain for good: row k is grain k.
struct SizedGrains {
  Columns<3> position;         ///< [d]
  Columns<3> velocity;         ///< [sqrt(g d)]
  Columns<3> spin;             ///< angular velocity [sqrt(g/d)]
  std::vector<double> radius;  ///< [d]
  std::vector<double> mass;    ///< [m]

  std::size_t count() const { return radius.size(); }
  void resize_to(std::size_t n) {
    for (auto* columns : {&position, &velocity, &spin}) resize(*columns, n);
    radius.resize(n, 0.5);
    mass.resize(n, 1);
  }
  double inertia(std::size_t i) const { return 0.4 * mass[i] * radius[i] * radius[i]; }

  /// (m/2) v^2 + (I/2) omega^2 summed over grains [m g d].
  double kinetic_energy() const {
    double energy = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      energy += 0.5 * mass[i] * row(velocity, i).squaredNorm() +
                0.5 * inertia(i) * row(spin, i).squaredNorm();
    }
    return energy;
  }
};

/// Mass of a sphere of diameter D and relative density rho (1: the small grains' material, of
/// which a sphere of d weighs m): rho D^3 [m].
inline double sphere_mass(double diameter, double relative_density) {
  return relative_density * diameter * diameter * diameter;
}

}  // namespace shakebed::simulator
