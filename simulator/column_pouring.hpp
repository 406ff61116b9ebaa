#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "simulator/contact/column_parameters.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/grains/column_filling.hpp"
#include "simulator/motion/column/archive.hpp"
#include "simulator/motion/column/stepper.hpp"
#include "simulator/scene/column.hpp"
#include "simulator/simulate.hpp"

namespace shakebed::simulator {

/// A bed that rests on the still base, with what its contacts remember.
struct PreparedBed {
  SizedGrains grains;
  std::vector<ContactMemory> memory;
  double height = 0;          ///< below which 99 % of the grains lie with their tops [d]
  double shaken_for = 0;      ///< [sqrt(d/g)]
  double relaxed_for = 0;     ///< [sqrt(d/g)]
  double kinetic_energy = 0;  ///< per grain, when it was taken as relaxed [m g d]

  template <class Archive>
  void archive(Archive& a) {
    for (auto* columns : {&grains.position, &grains.velocity, &grains.spin}) {
      for (auto& column : *columns) a(column);
    }
    a(grains.radius);
    a(grains.mass);
    a(memory);
    a(height);
    a(shaken_for);
    a(relaxed_for);
    a(kinetic_energy);
  }
};

inline ColumnContents contents_of(const Scene& scene) {
  const ColumnScene& column = *scene.column;
  return {0.5 * column.diameter, scene.grains.count,    column.smallest,     column.largest,
          column.has_large,      column.large_diameter, column.large_density};
}

template <class Physics>
Physics bind_column_physics(const Scene& scene, double time_step, long steps_per_cycle) {
  const ColumnScene& column = *scene.column;
  return Physics{typename Physics::Pair(column.grain),
                 typename Physics::Wall(column.wall),
                 {0.5 * column.diameter},
                 {scene.base.drive.amplitude, scene.base.drive.peak_velocity()},
                 {column.background_damping, column.air_damping, column.air_packing_fraction},
                 scene.gravity,
                 time_step,
                 steps_per_cycle,
                 column.frame == ContainerFrame::co_moving,
                 column.predict_velocities,
                 column.list_skin};
}

/// What the packing of a bed goes by: its container shaken fast and gently, no drag, in the
/// container's frame, so that a held grain is at rest.
inline Scene packing_scene(const Scene& scene) {
  Scene packed = scene;
  auto& column = *packed.column;
  const double omega = 2 * std::numbers::pi * column.prepare_frequency;
  packed.base.drive = {column.prepare_Gamma / (omega * omega), omega};
  column.background_damping = column.air_damping = 0;
  column.frame = ContainerFrame::co_moving;
  column.predict_velocities = true;
  column.list_skin = ColumnScene().list_skin;
  column.time_step.reset();
  packed.protocol.time_step_fraction = 0.04;
  return packed;
}

/// The still base under a drag of 0.5 m sqrt(g/d), which hastens what contacts do; at rest it has
/// no force.
template <class Physics>
Physics bind_packing_at_rest(const Scene& packing) {
  const auto p = bind_column(packing);
  auto still = bind_column_physics<Physics>(packing, p.time_step, p.steps_per_cycle);
  still.base = {0, 0};
  still.drag.background = 0.5;
  return still;
}

inline void stop_if_asked(const RunControl& control) {
  if (control.stop_requested && control.stop_requested()) throw files::Interrupted();
}

/// Returns how long it took; the energy per grain may still be higher if it took too long.
template <class Mover>
double bring_to_rest(Mover& mover, double time_step, double energy, const RunControl& control) {
  constexpr double longest = 200;  // sqrt(d/g)
  const long steps = std::lround(1 / time_step);
  double took = 0;
  double now = 0;
  do {
    stop_if_asked(control);
    mover.advance(steps);
    took += static_cast<double>(steps) * time_step;
    const auto& grains = mover.synchronised();
    now = grains.kinetic_energy() / static_cast<double>(grains.count());
  } while (now > energy && took < longest);
  return took;
}

/// The part of the preparation that knows no friction, and so is the same for scenes that differ in
/// it: the large grain is held at the bottom, small grains rain on it while the container is
/// shaken until the height of the centre of mass is steady; the shaking stops and the bed comes to
/// rest, before friction can lock the pressure of the last blow in.
template <class OverlapLaw>
class Pouring {
 public:
  Pouring(const Scene& packing, const RunControl& control)
      : control_(control), scene_(without_friction(packing)) {}

  PreparedBed make() {
    PreparedBed bed;
    bed.grains = fill_column(contents_of(scene_), scene_.seed);
    shake(bed);
    calm(bed);
    return bed;
  }

 private:
  using Physics = ColumnPhysics<OverlapLaw, Frictionless, Frictionless>;

  static constexpr double longest_shaking = 150;  // sqrt(d/g)
  static constexpr double steady = 2e-3;          // of the centre of mass's height
  static constexpr double look_every = 10;        // sqrt(d/g)

  static Scene without_friction(const Scene& packing) {
    Scene slick = packing;
    slick.column->grain.friction = slick.column->wall.friction = 0;
    return slick;
  }

  ColumnStepper<Physics> mover_of(const Physics& physics, const PreparedBed& bed) const {
    const std::int64_t held = scene_.column->has_large ? 0 : -1;
    return {physics, bed.grains, 0, {}, held, control_.crew};
  }

  void shake(PreparedBed& bed) {
    const auto p = bind_column(scene_);
    const auto shaken = bind_column_physics<Physics>(scene_, p.time_step, p.steps_per_cycle);
    auto mover = mover_of(shaken, bed);
    const double period = static_cast<double>(shaken.steps_per_cycle) * shaken.time_step;
    const long looks = std::max(1L, std::lround(look_every / period));
    double before = 1e300;
    while (bed.shaken_for < longest_shaking) {
      double mean = 0;
      for (long k = 0; k < looks; ++k) {
        stop_if_asked(control_);
        mover.advance(shaken.steps_per_cycle);
        mean += centre_of(mover.synchronised()) / static_cast<double>(looks);
      }
      bed.shaken_for += static_cast<double>(looks) * period;
      const bool settled = std::abs(mean - before) < steady * mean;
      before = mean;
      if (settled) break;
    }
    bed.grains = mover.synchronised();
  }

  void calm(PreparedBed& bed) {
    const auto still = bind_packing_at_rest<Physics>(scene_);
    auto mover = mover_of(still, bed);
    bed.relaxed_for += bring_to_rest(mover, still.time_step,
                                     100 * scene_.column->prepare_kinetic_energy, control_);
    bed.grains = mover.synchronised();
  }

  static double centre_of(const SizedGrains& grains) {
    double sum = 0;
    for (const double z : grains.position[2]) sum += z;
    return sum / static_cast<double>(grains.count());
  }

  const RunControl& control_;
  Scene scene_;
};

}  // namespace shakebed::simulator
