#pragma once

#include <string>

#include "simulator/scene/scene.hpp"

namespace shakebed::cli {

/// A bed in a shaken cylinder as one self-contained input file for LAMMPS (29 Sep 2021 or newer,
/// package GRANULAR): pair_style and walls gran/hooke/history with the scene's k_n, k_t, gamma_n,
/// gamma_t and friction, large grain, sizes, background drag, drive and time step. The start is
/// LAMMPS' own: grains fall without friction and relax with it, the base at its lowest, where
/// LAMMPS' walls begin their stroke; no shaking packs the bed. It writes the large grain's and the
/// centre of mass' height and velocity and the coordination number at 20 phases of each cycle.
/// `name` is said in the first line.
///
/// Throws files::Error(bad_input) for Hertzian contacts (LAMMPS' f is sqrt(delta R_eff), not
/// sqrt(delta/d): no single k_n makes them equal for all kinds of contact) and for air drag.
std::string lammps_column_deck(const simulator::Scene& scene, const std::string& name);

}  // namespace shakebed::cli
