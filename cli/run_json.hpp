#pragma once

#include <nlohmann/json_fwd.hpp>

#include "simulator/record.hpp"
#include "simulator/scene/accuracy.hpp"

namespace shakebed::cli {

/// The JSON of `shakebed run --json` (a contract): physics_version, seed, dimension, grains,
/// layers, W (null at g = 0), Gamma, cycles, k_n, time_step, contact_duration, steps_per_cycle,
/// T_x, T_y (null in 2D), T_z, T as {scaled, value} of {mean, standard_error}, the same with _lab
/// and _volume, h_cm and delta_h_cm {mean, standard_error}, rest_height [d], largest_overlap [d],
/// collisions, contact_steps, the event engine's counters (null
/// with the uniform engine), cpu_seconds, cpu_seconds_measuring, stationary, stationary_reason,
/// at_rest, warnings. Numbers that could not be estimated are null.
nlohmann::ordered_json run_json(const simulator::Record& record, double process_cpu_seconds);

/// The additional key `accuracy` of scenes that ask for one: asked, bias_bound, noise and reached
/// as shares of T_z, met.
nlohmann::ordered_json accuracy_json(const simulator::ReachedAccuracy& reached);

}  // namespace shakebed::cli
