#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "simulator/contact/column_parameters.hpp"
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
                 column.predict_velocities};
}

/// Packs a bed as Sun 2006 does: the large grain is held at the bottom, small grains rain on it
/// while the container is shaken fast and gently, until the height of the centre of mass is steady;
/// then the shaking stops, the large grain is let go, and the bed relaxes until its kinetic energy
/// is below the scene's bound. In the container's frame, so that the held grain is at rest.
///
/// Ours, as the paper does not say: friction is off until the bed has calmed down, since blows
/// would wedge grains between the walls for good, with forces a hundred times the bed's weight; and
/// while it relaxes, a drag of 0.5 m sqrt(g/d) and gamma_t = 40 sqrt(g/d) hasten what contacts do
/// (at rest neither has a force).
template <class Physics>
class Preparation {
 public:
  Preparation(const Scene& scene, const RunControl& control)
      : control_(control), scene_(quiet(scene)), wanted_(scene.column->prepare_kinetic_energy) {}

  PreparedBed make() {
    PreparedBed bed;
    bed.grains = fill_column(contents_of(scene_), scene_.seed);
    shake(bed);
    calm(bed);
    relax(bed);
    bed.height = height_of(bed.grains);
    return bed;
  }

 private:
  static constexpr double longest_shaking = 150;     // sqrt(d/g)
  static constexpr double longest_relaxation = 200;  // sqrt(d/g)
  static constexpr double steady = 2e-3;             // of the centre of mass's height
  static constexpr double look_every = 10;           // sqrt(d/g)

  static Scene quiet(const Scene& scene) {
    Scene packed = scene;
    auto& column = *packed.column;
    const double omega = 2 * std::numbers::pi * column.prepare_frequency;
    packed.base.drive = {column.prepare_Gamma / (omega * omega), omega};
    column.background_damping = column.air_damping = 0;
    column.frame = ContainerFrame::co_moving;
    column.predict_velocities = true;
    column.time_step.reset();
    packed.protocol.time_step_fraction = 0.04;
    return packed;
  }

  Physics physics() const {
    const auto p = bind_column(scene_);
    return bind_column_physics<Physics>(scene_, p.time_step, p.steps_per_cycle);
  }

  void poll() const {
    if (control_.stop_requested && control_.stop_requested()) throw files::Interrupted();
  }

  /// Without friction, and the large grain held where it is.
  ColumnStepper<Physics> frictionless_mover(Physics slick, const PreparedBed& bed) const {
    without_friction(slick.grain_grain);
    without_friction(slick.grain_wall);
    const std::int64_t held = scene_.column->has_large ? 0 : -1;
    return {slick, bed.grains, 0, {}, held};
  }

  void shake(PreparedBed& bed) {
    const auto shaken = physics();
    auto mover = frictionless_mover(shaken, bed);
    const double period = static_cast<double>(shaken.steps_per_cycle) * shaken.time_step;
    const long looks = std::max(1L, std::lround(look_every / period));
    double before = 1e300;
    while (bed.shaken_for < longest_shaking) {
      double mean = 0;
      for (long k = 0; k < looks; ++k) {
        poll();
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

  /// Comes to rest before friction can lock the pressure of the last blow in.
  void calm(PreparedBed& bed) {
    const auto still = at_rest();
    auto mover = frictionless_mover(still, bed);
    bed.relaxed_for += bring_to_rest(mover, still.time_step, 100 * wanted_);
    bed.grains = mover.synchronised();
  }

  void relax(PreparedBed& bed) {
    const auto still = at_rest();
    if (scene_.column->has_large) set_row(bed.grains.velocity, 0, Vector<3>(0, 0, 0));
    ColumnStepper<Physics> mover(still, bed.grains);
    bed.relaxed_for += bring_to_rest(mover, still.time_step, wanted_);
    bed.grains = mover.synchronised();
    bed.kinetic_energy = bed.grains.kinetic_energy() / static_cast<double>(bed.grains.count());
    for (const auto& c : mover.contacts()) bed.memory.push_back({c.i, c.j, c.memory});
  }

  Physics at_rest() const {
    auto still = physics();
    still.base = {0, 0};
    still.drag.background = 0.5;
    add_dashpot(still.grain_grain);
    add_dashpot(still.grain_wall);
    return still;
  }

  /// Returns how long it took; the energy per grain may still be higher if it took too long.
  double bring_to_rest(ColumnStepper<Physics>& mover, double time_step, double energy) const {
    const long steps = std::lround(1 / time_step);
    double took = 0;
    double now = 0;
    do {
      poll();
      mover.advance(steps);
      took += static_cast<double>(steps) * time_step;
      const auto& grains = mover.synchronised();
      now = grains.kinetic_energy() / static_cast<double>(grains.count());
    } while (now > energy && took < longest_relaxation);
    return took;
  }

  template <class Contact>
  static void without_friction(Contact& contact) {
    SpringKind kind = contact.kind;
    kind.friction = 0;
    contact = Contact(kind);
  }

  template <class Contact>
  static void add_dashpot(Contact& contact) {
    SpringKind kind = contact.kind;
    kind.tangential_rate = std::max(kind.tangential_rate, 40.0);
    contact = Contact(kind);
  }

  static double centre_of(const SizedGrains& grains) {
    double sum = 0;
    for (const double z : grains.position[2]) sum += z;
    return sum / static_cast<double>(grains.count());
  }

  static double height_of(const SizedGrains& grains) {
    std::vector<double> tops;
    for (std::size_t i = 0; i < grains.count(); ++i) {
      tops.push_back(grains.position[2][i] + grains.radius[i]);
    }
    const auto place =
        tops.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(tops.size() - 1));
    std::nth_element(tops.begin(), place, tops.end());
    return *place;
  }

  const RunControl& control_;
  Scene scene_;
  double wanted_;
};

/// The scene's prepared bed: from the store, or made and put there.
template <class Physics>
PreparedBed prepared_bed(const Scene& scene, const RunControl& control) {
  const std::string name = "prepared bed, physics version " + std::to_string(physics_version) +
                           "\n" + preparation_text(scene);
  PreparedBed bed;
  if (control.store != nullptr) {
    if (const auto bytes = control.store->load(name)) {
      ByteReader reader(*bytes, "prepared bed");
      bed.archive(reader);
      reader.finish();
      return bed;
    }
  }
  bed = Preparation<Physics>(scene, control).make();
  if (control.store != nullptr) {
    ByteWriter writer;
    bed.archive(writer);
    control.store->save(name, std::move(writer).take());
  }
  return bed;
}

}  // namespace shakebed::simulator
