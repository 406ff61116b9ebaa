#pragma once

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "simulator/bed.hpp"
#include "simulator/column_preparation.hpp"
#include "simulator/contact/cundall_strack.hpp"
#include "simulator/motion/column/reference.hpp"
#include "simulator/observables/column_series.hpp"
#include "simulator/observables/column_snapshot.hpp"
#include "simulator/observables/snapshot.hpp"
#include "simulator/record_notes.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::simulator {

/// Runs a prepared bed for the scene's cycles, phase by phase. The base begins to move at T = 0 at
/// its mean height, upwards at full speed, and the bed with it: no first blow.
template <class Physics, class Mover>
class ColumnRun {
 public:
  ColumnRun(const Scene& scene, const RunControl& control)
      : scene_(scene),
        control_(control),
        parameters_(bind_column(scene)),
        physics_(bind_column_physics<Physics>(scene, parameters_.time_step,
                                              parameters_.steps_per_cycle)),
        bed_(prepared_bed<Physics>(scene, control)),
        mover_(make_mover(begun(bed_.grains))) {}

  void go() {
    resume();
    const long cycles = scene_.protocol.cycles.value_or(1);
    const long stride = parameters_.steps_per_cycle / column_phases;
    while (static_cast<long>(series_.size()) < cycles * column_phases) {
      const long sampled = static_cast<long>(series_.size());
      if (control_.stop_requested && control_.stop_requested()) {
        save();
        throw files::Interrupted();
      }
      if (sampled % column_phases == 0) {
        if (control_.on_progress) {
          control_.on_progress(static_cast<double>(sampled) /
                               static_cast<double>(cycles * column_phases));
        }
        if (thread_cpu_seconds() - saved_at_ > seconds_between_saves) save();
      }
      sample();
      advance_with_snapshots(stride);
    }
    if (control_.store != nullptr) control_.store->forget(checkpoint_name());
  }

  void write(Record& record) {
    const ColumnScene& column = *scene_.column;
    const auto& drive = scene_.base.drive;
    record.scalars = {
        {"grains", "1", static_cast<double>(bed_.grains.count())},
        {"layers", "1", scene_.grains.layers},
        {"W", "1", scene_.W()},
        {"Gamma", "1", scene_.Gamma()},
        {"V_p", "sqrt(g d)", drive.peak_velocity()},
        {"amplitude", "d", drive.amplitude},
        {"angular_frequency", "sqrt(g/d)", drive.angular_frequency},
        {"k_n", "m g/d", column.grain.normal_stiffness},
        {"mu", "1", column.grain.friction},
        {"mu_wall", "1", column.wall.friction},
        {"time_step", "sqrt(d/g)", parameters_.time_step},
        {"contact_duration", "sqrt(d/g)", parameters_.contact_duration},
        {"steps_per_cycle", "1", static_cast<double>(parameters_.steps_per_cycle)},
        {"cycles", "1", static_cast<double>(scene_.protocol.cycles.value_or(1))},
        {"initial_height", "d", bed_.height},
        {"shaken_for", "sqrt(d/g)", bed_.shaken_for},
        {"relaxed_for", "sqrt(d/g)", bed_.relaxed_for},
        {"prepared_kinetic_energy", "m g d", bed_.kinetic_energy},
        {"largest_overlap", "d", mover_.counters().largest_overlap},
        {"contact_steps", "1",
         static_cast<double>(mover_.counters().pair_steps + mover_.counters().wall_steps)}};
    write_column_series(record, series_, column_phases, 0.5 * column.large_diameter,
                        column.has_large);
    record.snapshots = std::move(snapshots_);
    record.stationary_reason = "a transient is followed from a packed bed at rest";
    warn_of_column(record, scene_, mover_.counters().largest_overlap);
  }

 private:
  static constexpr double seconds_between_saves = 60;
  static constexpr bool is_fast = std::is_same_v<Mover, ColumnStepper<Physics>>;

  Mover make_mover(const SizedGrains& grains) const {
    if constexpr (is_fast) return {physics_, grains, 0, bed_.memory, -1, control_.crew};
    if constexpr (!is_fast) return {physics_, grains, 0, bed_.memory};
  }

  SizedGrains begun(SizedGrains grains) const {
    const double up = physics_.co_moving ? 0 : physics_.base.peak_velocity;
    for (std::size_t i = 0; i < grains.count(); ++i) {
      set_row(grains.velocity, i, Vector<3>(0, 0, up));
      set_row(grains.spin, i, Vector<3>(0, 0, 0));
    }
    return grains;
  }

  void sample() {
    WallForces walls;
    for (const auto& contact : mover_.wall_contacts()) add_wall_force(walls, contact);
    series_.sample(mover_.synchronised(), scene_.column->has_large,
                   {mover_.touching_pairs(), mover_.touching_walls()}, walls,
                   physics_.lab_base_at(mover_.step_number()), physics_.co_moving);
  }

  /// Stops at the steps of snapshots on the way.
  void advance_with_snapshots(long steps) {
    const auto& wanted = scene_.protocol.snapshots;
    const long end = mover_.step_number() + steps;
    const long per_cycle = parameters_.steps_per_cycle;
    for (long cycle = wanted.from_cycle; cycle < wanted.from_cycle + wanted.cycles; ++cycle) {
      for (const double phase : wanted.phases) {
        const long at = cycle * per_cycle + std::lround(phase * static_cast<double>(per_cycle));
        if (at < mover_.step_number() || at >= end) continue;
        mover_.advance(at - mover_.step_number());
        auto& kept = snapshots_.emplace_back(
            column_snapshot(mover_.synchronised(), mover_.contacts(), physics_.lab_base_at(at),
                            Physics::turns_grains));
        kept.cycles = static_cast<double>(at) / static_cast<double>(per_cycle);
        kept.name = snapshot_name(static_cast<double>(cycle) + phase);
      }
    }
    mover_.advance(end - mover_.step_number());
  }

  std::string checkpoint_name() const {
    return "checkpoint by blocks, half rows, physics version " + std::to_string(physics_version) +
           "\n" + canonical_yaml(scene_);
  }

  template <class Archive>
  void archive(Archive& a) {
    mover_.archive(a);
    series_.archive(a);
    archive_snapshots(a, snapshots_);
  }

  void save() {
    saved_at_ = thread_cpu_seconds();
    if constexpr (is_fast) {
      if (control_.store == nullptr) return;
      ByteWriter writer;
      archive(writer);
      control_.store->save(checkpoint_name(), std::move(writer).take());
    }
  }

  /// Goes on from a checkpoint. Step number, and so the base's phase, are part of it.
  void resume() {
    saved_at_ = thread_cpu_seconds();
    if constexpr (is_fast) {
      if (control_.store == nullptr) return;
      const auto bytes = control_.store->load(checkpoint_name());
      if (!bytes) return;
      ByteReader reader(*bytes, "checkpoint");
      archive(reader);
      reader.finish();
    }
  }

  const Scene& scene_;
  const RunControl& control_;
  ColumnParameters parameters_;
  Physics physics_;
  PreparedBed bed_;
  Mover mover_;
  ColumnSeries series_;
  std::vector<Snapshot> snapshots_;
  double saved_at_ = 0;
};

/// Packing the bed is not part of its measured cycles.
template <class Run>
void run_timed(Run& run, Record& record, const RunControl& control) {
  const double packed = thread_cpu_seconds();
  run.go();
  record.timing.cpu_seconds_measuring = (thread_cpu_seconds() - packed) * threads_of(control);
  run.write(record);
}

template <class Physics>
void run_column_with(Record& record, const Scene& scene, const RunControl& control) {
  if (scene.protocol.engine == Engine::uniform) {
    ColumnRun<Physics, ColumnReference<Physics>> run(scene, control);
    run_timed(run, record, control);
  } else {
    ColumnRun<Physics, ColumnStepper<Physics>> run(scene, control);
    run_timed(run, record, control);
  }
}

/// Which contacts have memory is known before the first step: those with friction.
template <class OverlapLaw>
void run_column(Record& record, const Scene& scene, const RunControl& control) {
  const bool rough = scene.column->grain.friction > 0;
  const bool rough_wall = scene.column->wall.friction > 0;
  using Spring = CundallStrack;
  if (rough && rough_wall) {
    run_column_with<ColumnPhysics<OverlapLaw, Spring, Spring>>(record, scene, control);
  } else if (rough) {
    run_column_with<ColumnPhysics<OverlapLaw, Spring, Frictionless>>(record, scene, control);
  } else if (rough_wall) {
    run_column_with<ColumnPhysics<OverlapLaw, Frictionless, Spring>>(record, scene, control);
  } else {
    run_column_with<ColumnPhysics<OverlapLaw, Frictionless, Frictionless>>(record, scene, control);
  }
}

}  // namespace shakebed::simulator
