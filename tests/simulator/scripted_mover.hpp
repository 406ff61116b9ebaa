#pragma once

#include <functional>
#include <utility>

#include "simulator/bed.hpp"

namespace shakebed::tests {

/// Two grains that move as told: w = bulk + relative and bulk - relative, whatever the physics. It
/// goes through the same protocol and measurement as an engine.
template <int D>
class ScriptedMover {
 public:
  struct Motion {
    double relative = 0;  ///< T_z = relative^2/2 at this instant
    double bulk = 0;      ///< moves both grains alike
    double height = 1;
    double base_power = 0;
    double dissipation_power = 0;
    double leak = 0;  ///< power that no ledger sees
  };
  using Script = std::function<Motion(long cycle, double phase)>;

  ScriptedMover(const simulator::Parameters& parameters, Script script)
      : steps_per_cycle_(parameters.steps_per_cycle),
        time_step_(parameters.time_step),
        script_(std::move(script)) {
    grains_.resize_to(2);
  }

  void advance(long steps) {
    const Motion motion = now();
    const double time = static_cast<double>(steps) * time_step_;
    ledger_.base_work += motion.base_power * time;
    ledger_.dissipation += motion.dissipation_power * time;
    energy_ += (motion.base_power - motion.dissipation_power - motion.leak) * time;
    step_ += steps;
  }
  const simulator::Grains<D, false>& synchronised() {
    const Motion motion = now();
    grains_.velocity[D - 1] = {motion.bulk + motion.relative, motion.bulk - motion.relative};
    grains_.position[D - 1] = {motion.height, motion.height};
    asked_.push_back(step_);
    return grains_;
  }
  simulator::EnergyLedger& ledger() { return ledger_; }
  double energy() { return energy_; }

  const std::vector<long>& asked() const { return asked_; }  ///< steps at which it was looked at

 private:
  Motion now() const {
    const long cycle = step_ / steps_per_cycle_;
    const long in_cycle = step_ % steps_per_cycle_;
    return script_(cycle, static_cast<double>(in_cycle) / static_cast<double>(steps_per_cycle_));
  }

  long steps_per_cycle_;
  double time_step_;
  Script script_;
  long step_ = 0;
  double energy_ = 0;
  simulator::Grains<D, false> grains_;
  simulator::EnergyLedger ledger_;
  std::vector<long> asked_;
};

/// A scene of two grains whose base does what the default says; only its protocol matters here.
template <int D>
simulator::Scene scripted_scene() {
  simulator::Scene scene;
  scene.dimension = D;
  scene.cell.assign(D - 1, 5.0);
  scene.grains.count = 2;
  scene.base.drive = {1, 2};
  scene.protocol.transient = 0;
  return scene;
}

/// Measures a scripted mover by the scene's protocol.
template <int D>
simulator::Record measure_script(const simulator::Scene& scene,
                                 typename ScriptedMover<D>::Script script,
                                 std::vector<long>* asked = nullptr) {
  const auto parameters = simulator::bind_parameters(scene);
  ScriptedMover<D> mover(parameters, std::move(script));
  const simulator::RunControl control;
  simulator::Protocol<ScriptedMover<D>, D> protocol(scene, parameters, mover, control);
  simulator::Measurement<D> measurement(scene, 0);
  protocol.discard();
  protocol.open_books();
  protocol.measure(measurement);
  simulator::Record record;
  record.scalars.push_back({"transient", "cycles", static_cast<double>(protocol.discarded())});
  measurement.write(record, mover.ledger(), protocol.energy_change());
  if (asked) *asked = mover.asked();
  return record;
}

inline simulator::Estimate quantity(const simulator::Record& record, const std::string& name) {
  for (const auto& q : record.quantities) {
    if (q.name == name) return q.estimate;
  }
  return {};
}

inline double scalar(const simulator::Record& record, const std::string& name) {
  for (const auto& s : record.scalars) {
    if (s.name == name) return s.value;
  }
  return std::nan("");
}

}  // namespace shakebed::tests
