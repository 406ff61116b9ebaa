#pragma once

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "simulator/contact/spring_kind.hpp"
#include "simulator/grains/sized_grains.hpp"

// A bed in a shaken cylinder, as it stands, for LAMMPS' gran/hooke/history. LAMMPS' walls start at
// their lowest: our three quarters of a cycle. It knows nothing of what contacts remember.
namespace shakebed::tests {

/// Kn Kt gamma_n gamma_t xmu dampflag.
inline std::string words(const simulator::SpringKind& kind) {
  char text[200];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g %.17g %.17g 1", kind.normal_stiffness,
                kind.tangential_stiffness, kind.normal_rate, kind.tangential_rate, kind.friction);
  return text;
}

inline void write_data(const std::filesystem::path& file, const simulator::SizedGrains& grains) {
  std::ofstream data(file);
  data.precision(17);
  data << "bed\n\n"
       << grains.count() << " atoms\n1 atom types\n\n"
       << "-50 50 xlo xhi\n-50 50 ylo yhi\n-50 400 zlo zhi\n\nAtoms # sphere\n\n";
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const double volume = std::numbers::pi / 6 * std::pow(2 * grains.radius[i], 3);
    const auto x = simulator::row(grains.position, i);
    data << i + 1 << " 1 " << 2 * grains.radius[i] << ' ' << grains.mass[i] / volume << ' ' << x[0]
         << ' ' << x[1] << ' ' << x[2] << '\n';
  }
  data << "\nVelocities\n\n";
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const auto v = simulator::row(grains.velocity, i);
    const auto w = simulator::row(grains.spin, i);
    data << i + 1;
    for (int c = 0; c < 3; ++c) data << ' ' << v[c];
    for (int c = 0; c < 3; ++c) data << ' ' << w[c];
    data << '\n';
  }
}

/// What a deck says before it runs: read bed.data, contacts, walls, gravity.
template <class Physics>
void write_deck_head(std::ostream& deck, const Physics& physics, const simulator::SpringKind& grain,
                     const simulator::SpringKind& wall, double radius, double skin) {
  deck.precision(17);
  const double period = physics.time_step * static_cast<double>(physics.steps_per_cycle);
  const double A = physics.base.amplitude;
  const auto wiggle = [&] { deck << " wiggle z " << A << ' ' << period << '\n'; };
  deck << "units lj\natom_style sphere\nboundary f f f\nnewton off\ncomm_modify vel yes\n"
          "read_data bed.data\npair_style gran/hooke/history "
       << words(grain) << "\npair_coeff * *\nneighbor " << skin << " bin\ntimestep "
       << physics.time_step
       << "\nfix gravity all gravity 1 vector 0 0 -1\nfix move all nve/sphere\n"
       << "fix base all wall/gran hooke/history " << words(wall) << " zplane " << -A << " NULL";
  wiggle();
  deck << "fix side all wall/gran hooke/history " << words(wall) << " zcylinder " << radius;
  wiggle();
}

}  // namespace shakebed::tests
