#pragma once

#include <string>
#include <vector>

namespace shakebed::bench {

/// True when a program `lmp` is on PATH.
bool lammps_is_here();

/// CPU seconds of every `run` of a deck, from what LAMMPS wrote on the screen: "Loop time" times
/// "% CPU use". Throws with LAMMPS' last words when there is none.
std::vector<double> cpu_seconds_of_runs(const std::string& screen);

/// CPU seconds that LAMMPS took for the measured cycles of a deck (not for settling and transient):
/// its last run. Throws with LAMMPS' last words when it fails.
double lammps_cpu_seconds(const std::string& deck, long steps_per_cycle);

}  // namespace shakebed::bench
