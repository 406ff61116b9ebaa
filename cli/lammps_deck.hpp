#pragma once

#include <string>

#include "simulator/scene/scene.hpp"

namespace shakebed::cli {

/// The scene as one self-contained input file for LAMMPS (29 Sep 2021 or newer, package GRANULAR):
/// the same contact law, parameters, base, cell and sampling, with a start, settling and time
/// integration of LAMMPS' own. `name` is said in the first line.
///
/// pair_style gran/hooke is Bhateja 2016, Eqs. A5-A8, with damping per effective mass:
/// gamma_n = c_n/m_eff [sqrt(g/d)], gamma_t = c_t/m_eff, where m_eff = m/2 between grains and m at
/// the base. It evaluates damping and friction with velocities half a step late, which biases T_z
/// by about -1.6 % at dt = t_c/25, in proportion to dt: unless told otherwise on LAMMPS' command
/// line, the deck steps at t_c/75 or, if the scene's own step is finer, at that.
std::string lammps_deck(const simulator::Scene& scene, const std::string& name);

}  // namespace shakebed::cli
