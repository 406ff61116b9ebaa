#pragma once

#include <chrono>

#include "simulator/bed.hpp"
#include "simulator/motion/dense_engine.hpp"
#include "simulator/motion/events.hpp"
#include "simulator/observables/snapshot.hpp"
#include "simulator/record_notes.hpp"
#include "simulator/run_bed.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::simulator {

inline void write_counters(Record& record, const EventCounters& counters) {
  const auto add = [&](const char* name, long value) {
    record.scalars.push_back({name, "1", static_cast<double>(value)});
  };
  add("contacts_closed", counters.closed);
  add("contacts_fine", counters.fine);
  add("contacts_undone", counters.undone);
  add("breaches", counters.breaches);
  add("dense_steps", counters.dense_steps);
}

template <class MoverType>
void run_protocol(Record& record, const Scene& scene, const Parameters& p, MoverType& mover,
                  double rest_height, const RunControl& control,
                  const typename Protocol<MoverType, MoverType::D>::SnapshotTaker& snapshot) {
  constexpr int D = MoverType::D;
  Protocol<MoverType, D> protocol(scene, p, mover, control);
  if (!scene.protocol.snapshots.phases.empty()) protocol.take_snapshots_with(snapshot);
  Measurement<D> measurement(scene, rest_height);
  if (scene.protocol.until && !measurement.knows(scene.protocol.until->quantity)) {
    throw files::bad_input("protocol.measure.until",
                           "nothing called '" + scene.protocol.until->quantity +
                               "' is measured in this scene; use T_z, T_x, T or h_cm");
  }
  protocol.discard();
  protocol.open_books();
  const double measuring = thread_cpu_seconds();
  protocol.measure(measurement);
  record.timing.cpu_seconds_measuring = thread_cpu_seconds() - measuring;
  record.scalars.push_back({"transient", "cycles", static_cast<double>(protocol.discarded())});
  measurement.write(record, mover.ledger(), protocol.energy_change());
  record.snapshots = std::move(protocol.snapshots());
  warn(record, scene, p, mover.ledger());
}

template <class Physics>
Record run_bed(const Scene& scene, const RunControl& control) {
  constexpr int D = Physics::dimension;
  const double started = thread_cpu_seconds();
  const auto wall = std::chrono::steady_clock::now();
  const Parameters p = bind_parameters(scene);

  Record record;
  record.physics_version = physics_version;
  record.seed = scene.seed;
  record.dimension = D;
  record.canonical_scene = canonical_yaml(scene);
  write_parameters(record, scene, p);

  const auto bed = settle<Physics>(scene, control);
  const auto physics = bind_physics<Physics>(scene, p);
  const auto move_with = [&](auto& mover) {
    run_protocol(record, scene, p, mover, bed.rest_height, control, [&](long step, long cycle) {
      return snapshot_of(physics, mover.synchronised(), step, cycle);
    });
  };
  const auto move_uniformly = [&] {
    UniformStepper<Physics> mover(physics, bed.grains);
    move_with(mover);
  };
  if (scene.protocol.engine == Engine::uniform) {
    move_uniformly();
  } else if constexpr (Physics::walled) {
    DenseEngine<Physics> mover(physics, bed.grains);
    move_with(mover);
  } else {
    EventEngine<Physics> mover(physics, p, bed.grains, scene.protocol.contacts);
    move_with(mover);
    write_counters(record, mover.counters());
  }

  record.timing.cpu_seconds = thread_cpu_seconds() - started;
  record.timing.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return record;
}

}  // namespace shakebed::simulator
