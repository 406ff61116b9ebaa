#include "simulator/contact/frictionless.hpp"
#include "simulator/run_bed_definition.hpp"

namespace shakebed::simulator {

template Record run_bed<BedPhysics<2, Frictionless>>(const Scene&, const RunControl&);

}  // namespace shakebed::simulator
