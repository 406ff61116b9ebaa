#include "bench/baseline/bed.hpp"

#include "bench/baseline/uniform.hpp"
#include "simulator/run_bed_definition.hpp"

namespace shakebed::baseline {
namespace {

template <class Physics>
simulator::Record run(const simulator::Scene& scene) {
  const auto p = simulator::bind_parameters(scene);
  const auto bed = simulator::settle<Physics>(scene, {});
  const auto physics = simulator::bind_physics<Physics>(scene, p);
  UniformStepper<Physics> mover(physics, bed.grains);
  simulator::Record record;
  simulator::run_protocol(record, scene, p, mover, bed.rest_height, {},
                          [](long, long) { return simulator::Snapshot{}; });
  return record;
}

}  // namespace

simulator::Record simulate(const simulator::Scene& scene) {
  if (scene.dimension == 2) return run<BaselinePhysics<2, ViscousCoulomb>>(scene);
  return run<BaselinePhysics<3, ViscousCoulomb>>(scene);
}

}  // namespace shakebed::baseline
