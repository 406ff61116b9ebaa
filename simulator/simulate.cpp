#include "simulator/simulate.hpp"

#include <chrono>
#include <cstdio>

#include "simulator/bed.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/motion/events.hpp"
#include "simulator/observables/snapshot.hpp"
#include "simulator/scene/read_scene.hpp"

namespace shakebed::simulator {
namespace {

void write_parameters(Record& record, const Scene& scene, const Parameters& p) {
  const auto& drive = scene.base.drive;
  record.scalars = {{"grains", "1", static_cast<double>(scene.grains.count)},
                    {"layers", "1", scene.grains.layers},
                    {"Gamma", "1", scene.Gamma()},
                    {"V_p", "sqrt(g d)", drive.peak_velocity()},
                    {"amplitude", "d", drive.amplitude},
                    {"angular_frequency", "sqrt(g/d)", drive.angular_frequency},
                    {"k_n", "m g/d", p.stiffness},
                    {"time_step", "sqrt(d/g)", p.time_step},
                    {"contact_duration", "sqrt(d/g)", p.contact_duration},
                    {"steps_per_cycle", "1", static_cast<double>(p.steps_per_cycle)}};
  if (scene.gravity > 0) record.scalars.push_back({"W", "1", scene.W()});
}

void warn(Record& record, const Scene& scene, const Parameters& p, const EnergyLedger& ledger) {
  char text[240];
  if (p.time_step > 0.1 * p.contact_duration) {
    std::snprintf(text, sizeof text,
                  "time step is t_c/%.3g; above t_c/10 restitution and temperature are biased",
                  p.contact_duration / p.time_step);
    record.warnings.emplace_back(text);
  }
  constexpr double soft = 0.1;
  if (ledger.largest_overlap > soft) {
    std::snprintf(text, sizeof text,
                  "largest overlap %.3g d: contacts this soft change the bed; raise "
                  "contact.stiffness (now %.3g m g/d)",
                  ledger.largest_overlap, p.stiffness);
    record.warnings.emplace_back(text);
  }
  if (scene.protocol.until && !record.at_rest) {
    for (const auto& q : record.quantities) {
      const auto& wanted = *scene.protocol.until;
      if (q.name != wanted.quantity) continue;
      const double reached = q.estimate.standard_error / std::abs(q.estimate.mean);
      if (reached <= wanted.fraction) continue;
      std::snprintf(text, sizeof text,
                    "%s is known to %.2g %% after at_most = %ld cycles; %.2g %% was asked for",
                    q.name.c_str(), 100 * reached, scene.protocol.at_most, 100 * wanted.fraction);
      record.warnings.emplace_back(text);
    }
  }
}

void write_counters(Record& record, const EventCounters& counters) {
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
Record run(const Scene& scene, const RunControl& control) {
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
  if (scene.protocol.engine == Engine::uniform) {
    UniformStepper<Physics> mover(physics, bed.grains);
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

}  // namespace

Record simulate(const Scene& scene, const RunControl& control) {
  const bool rough = bind_parameters(scene).turns_grains;
  if (scene.dimension == 2) {
    return rough ? run<BedPhysics<2, ViscousCoulomb>>(scene, control)
                 : run<BedPhysics<2, Frictionless>>(scene, control);
  }
  return rough ? run<BedPhysics<3, ViscousCoulomb>>(scene, control)
               : run<BedPhysics<3, Frictionless>>(scene, control);
}

}  // namespace shakebed::simulator
