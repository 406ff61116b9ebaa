#pragma once

#include "simulator/simulate.hpp"

namespace shakebed::simulator {

/// Settles, shakes and measures one bed of the given composition. Defined in
/// run_bed_definition.hpp and compiled once per composition in beds/: one file each, because a
/// compiler that meets several engines in one file stops inlining their laws.
template <class Physics>
Record run_bed(const Scene& scene, const RunControl& control);

}  // namespace shakebed::simulator
