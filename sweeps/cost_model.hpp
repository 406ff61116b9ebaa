#pragma once

#include "simulator/scene/scene.hpp"

namespace shakebed::sweeps {

// Guesses, used to start the longest bed first and to say how long a sweep will take. They never
// touch a result.

/// Cycles a scene will measure: what it says, or for `until` what its precision is likely to take,
/// up to at_most. From measured correlation: cycles for a standard error of T_z of 1 % are
/// 60 / 210 / 1200 at W = 5.6 / 22 / 89 for 100 rough grains in 3D, and 900 / 5000 / 18000 for 40
/// smooth grains in 2D; they go as 1/N and as the square of the precision.
double predicted_cycles(const simulator::Scene& scene);

/// CPU seconds on one core of a current machine. Uniform engine: grains x steps x the cost of a
/// grain and step, which depends on how many grains touch. Event engine: grains x cycles x the cost
/// of the collisions of a grain in a cycle.
double predicted_cpu_seconds(const simulator::Scene& scene);

}  // namespace shakebed::sweeps
