#pragma once

#include "simulator/record.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::baseline {

/// Settles, shakes and measures a scene as simulator::simulate does, moved by the frozen stepper.
simulator::Record simulate(const simulator::Scene& scene);

}  // namespace shakebed::baseline
