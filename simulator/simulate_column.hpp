#pragma once

#include "simulator/simulate.hpp"

namespace shakebed::simulator {

/// A bed in a container, by law of the normal contact; files apart keep compile times bearable.
void run_linear_column(Record& record, const Scene& scene, const RunControl& control);
void run_hertz_column(Record& record, const Scene& scene, const RunControl& control);

}  // namespace shakebed::simulator
