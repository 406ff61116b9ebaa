#pragma once

#include <cstddef>

#include "simulator/dimension.hpp"

namespace shakebed::simulator {

inline constexpr double grain_radius = 0.5;                                     ///< [d]
inline constexpr double grain_inertia = 0.4 * grain_radius * grain_radius;      ///< (2/5) m R^2
inline constexpr double grain_volume = 3.14159265358979323846 / 6;              ///< [d^3]
inline constexpr double grain_cross_section_area = 3.14159265358979323846 / 4;  ///< [d^2]

/// State of all grains at one instant: positions of centres [d], velocities [sqrt(g d)] and, only
/// when a contact law turns grains, angular velocities [sqrt(g/d)].
template <int D, bool TurnsGrains>
struct Grains {
  static constexpr int spin_columns = TurnsGrains ? Dimension<D>::spin_components : 0;

  Columns<D> position;
  Columns<D> velocity;
  Columns<spin_columns> spin;

  std::size_t count() const { return position[0].size(); }
  void resize_to(std::size_t count) {
    resize(position, count);
    resize(velocity, count);
    resize(spin, count);
  }
};

/// (m/2) v^2 + (I/2) omega^2 + m g z, summed over grains [m g d].
template <int D, bool TurnsGrains>
double mechanical_energy(const Grains<D, TurnsGrains>& grains, double gravity) {
  double energy = 0;
  for (const auto& column : grains.velocity) {
    for (const double v : column) energy += 0.5 * v * v;
  }
  for (const auto& column : grains.spin) {
    for (const double omega : column) energy += 0.5 * grain_inertia * omega * omega;
  }
  for (const double z : grains.position[Dimension<D>::vertical]) energy += gravity * z;
  return energy;
}

}  // namespace shakebed::simulator
