#include "simulator/simulate.hpp"

#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/motion/walled_physics.hpp"
#include "simulator/run_bed.hpp"

namespace shakebed::simulator {
namespace {

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

Record simulate(const Scene& scene, const RunControl& control) {
  return scene.walled() ? run_in<WalledPhysics>(scene, control)
                        : run_in<BedPhysics>(scene, control);
}

}  // namespace shakebed::simulator
