#pragma once

#include <functional>

#include "simulator/bed_store.hpp"
#include "simulator/crew.hpp"
#include "simulator/record.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// Raised with every change of the numbers that a scene and seed give.
inline constexpr int physics_version = 1;

/// How a caller watches and stops a run. Neither changes a result.
struct RunControl {
  std::function<bool()> stop_requested;  ///< polled once a cycle; true: throws files::Interrupted
  /// Fraction of the expected work done, in [0, 1], about once a cycle.
  std::function<void(double)> on_progress;
  const BedStore* store = nullptr;  ///< used by beds in a container
  Crew* crew = nullptr;             ///< shares the work of a bed in a container
};

inline int threads_of(const RunControl& control) {
  return control.crew != nullptr ? control.crew->threads() : 1;
}

/// How many threads can share the work on one bed of this scene.
int useful_threads(const Scene& scene);

/// One bed, one thread but for those of `crew`: fill, settle, discard the transient, measure.
/// Throws files::Error when the scene cannot be simulated.
Record simulate(const Scene& scene, const RunControl& control = {});

}  // namespace shakebed::simulator
