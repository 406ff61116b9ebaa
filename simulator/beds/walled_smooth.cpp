#include "simulator/contact/frictionless.hpp"
#include "simulator/run_bed_definition.hpp"

namespace shakebed::simulator {

template Record run_bed<WalledPhysics<2, Frictionless>>(const Scene&, const RunControl&);
template Record run_bed<WalledPhysics<3, Frictionless>>(const Scene&, const RunControl&);

}  // namespace shakebed::simulator
