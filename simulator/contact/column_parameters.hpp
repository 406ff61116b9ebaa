#pragma once

#include <string>
#include <vector>

#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// One kind of contact of a bed in a container, with what it comes to under the linear law.
struct ColumnContactKind {
  std::string name;  ///< "small-small", "large-wall", ...
  SpringKind spring;
  double effective_mass;    ///< [m]
  double contact_duration;  ///< t_c [sqrt(d/g)]; infinite when over-damped
  double restitution;       ///< e; 0 when over-damped
};

struct ColumnParameters {
  std::vector<ColumnContactKind> kinds;
  /// What the step must resolve [sqrt(d/g)]: t_c of the shortest kind, or pi/gamma_n where that is
  /// shorter (an over-damped contact has no t_c, but its dashpot stops a grain in about 1/gamma_n).
  double contact_duration;
  double time_step;      ///< [sqrt(d/g)]; divides the drive's period
  long steps_per_cycle;  ///< a multiple of column_phases
};

/// Equal phases of a cycle at which a bed in a container is looked at.
inline constexpr long column_phases = 160;

/// What a scene with a container comes to. For Hertzian contacts t_c and e, which depend on the
/// closing speed there, are those of the linear law at the same k_n, a lower bound of t_c while
/// overlaps are below d.
ColumnParameters bind_column(const Scene& scene);

}  // namespace shakebed::simulator
