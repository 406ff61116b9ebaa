#include "simulator/simulate.hpp"

#include <chrono>

#include "simulator/bed.hpp"
#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/motion/column/block_cuts.hpp"
#include "simulator/motion/walled_physics.hpp"
#include "simulator/run_bed.hpp"
#include "simulator/scene/read_scene.hpp"
#include "simulator/simulate_column.hpp"

namespace shakebed::simulator {
namespace {

Record run_in_container(const Scene& scene, const RunControl& control) {
  const double started = thread_cpu_seconds();
  const auto wall = std::chrono::steady_clock::now();
  Record record;
  record.physics_version = physics_version;
  record.seed = scene.seed;
  record.dimension = scene.dimension;
  record.canonical_scene = canonical_yaml(scene);
  const bool hertz = scene.column->overlap_law == OverlapLaw::hertz;
  (hertz ? run_hertz_column : run_linear_column)(record, scene, control);
  record.timing.cpu_seconds = (thread_cpu_seconds() - started) * threads_of(control);
  record.timing.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return record;
}

template <template <int, class> class Physics>
Record run_in(const Scene& scene, const RunControl& control) {
  const bool rough = bind_parameters(scene).turns_grains;
  if (scene.dimension == 2) {
    return rough ? run_bed<Physics<2, ViscousCoulomb>>(scene, control)
                 : run_bed<Physics<2, Frictionless>>(scene, control);
  }
  return rough ? run_bed<Physics<3, ViscousCoulomb>>(scene, control)
               : run_bed<Physics<3, Frictionless>>(scene, control);
}

}  // namespace

int useful_threads(const Scene& scene) {
  if (!scene.column || scene.protocol.engine == Engine::uniform) return 1;
  const auto grains = static_cast<std::size_t>(scene.grains.count) + scene.column->has_large;
  return static_cast<int>(BlockCuts(grains).count());
}

Record simulate(const Scene& scene, const RunControl& control) {
  if (scene.column) return run_in_container(scene, control);
  return scene.walled() ? run_in<WalledPhysics>(scene, control)
                        : run_in<BedPhysics>(scene, control);
}

}  // namespace shakebed::simulator
