#include "simulator/simulate.hpp"

#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/motion/leapfrog.hpp"
#include "simulator/run_bed.hpp"

namespace shakebed::simulator {

Record simulate(const Scene& scene, const RunControl& control) {
  const bool rough = bind_parameters(scene).turns_grains;
  if (scene.dimension == 2) {
    return rough ? run_bed<BedPhysics<2, ViscousCoulomb>>(scene, control)
                 : run_bed<BedPhysics<2, Frictionless>>(scene, control);
  }
  return rough ? run_bed<BedPhysics<3, ViscousCoulomb>>(scene, control)
               : run_bed<BedPhysics<3, Frictionless>>(scene, control);
}

}  // namespace shakebed::simulator
