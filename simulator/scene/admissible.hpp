#pragma once

#include "simulator/scene/scene.hpp"
#include "simulator/scene/values.hpp"

namespace shakebed::simulator {

/// From the single values of a file to a scene: defaults, equivalent keys, physical units, and
/// whether the values fit together. What does not goes to the faults of `values`; the scene is
/// usable only when there are none.
Scene scene_from(SceneValues& values);

/// The same for base.drive alone; `diameter_mm` and `gravity_si` [m/s2] are the scene's units.
Drive drive_from(SceneValues& values, std::optional<double> diameter_mm, double gravity_si);

/// Lid, side walls and the direction of the drive; grains, cell and base must have been read.
void read_walls(SceneValues& values, Scene& scene);

/// The event engine knows the base alone.
void check_engine(SceneValues& values, const Scene& scene);

}  // namespace shakebed::simulator
