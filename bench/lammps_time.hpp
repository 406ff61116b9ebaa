#pragma once

#include <string>

namespace shakebed::bench {

/// True when a program `lmp` is on PATH.
bool lammps_is_here();

/// CPU seconds that LAMMPS took for the measured cycles of a deck (not for settling and transient):
/// its last "Loop time" times its last "% CPU use". Throws with LAMMPS' last words when it fails.
double lammps_cpu_seconds(const std::string& deck, long steps_per_cycle);

}  // namespace shakebed::bench
