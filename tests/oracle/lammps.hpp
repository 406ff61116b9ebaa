#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "simulator/scene/scene.hpp"

namespace shakebed::tests {

/// Per-cycle averages by name (T_x, T_z, h_cm, ...), as the deck's columns are called.
using CycleAverages = std::map<std::string, std::vector<double>>;

/// True when a program `lmp` is on PATH and knows the granular styles.
bool lammps_is_here();

/// Runs the scene's exported deck in a folder of its own, one thread, and reads what it averaged.
/// Throws with LAMMPS' last words when it fails. Safe to call from several threads at once.
CycleAverages run_lammps(const simulator::Scene& scene, std::uint64_t seed);

/// The same of a bed in a container, whose deck writes rows at equal phases of each cycle.
CycleAverages run_lammps_column(const simulator::Scene& scene, std::uint64_t seed);

}  // namespace shakebed::tests
