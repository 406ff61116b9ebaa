#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/run_bed_definition.hpp"

namespace shakebed::simulator {

template Record run_bed<WalledPhysics<2, ViscousCoulomb>>(const Scene&, const RunControl&);
template Record run_bed<WalledPhysics<3, ViscousCoulomb>>(const Scene&, const RunControl&);

}  // namespace shakebed::simulator
