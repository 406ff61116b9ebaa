#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/run_bed_definition.hpp"

namespace shakebed::simulator {

template class EventEngine<BedPhysics<2, ViscousCoulomb>>;
template Record run_bed<BedPhysics<2, ViscousCoulomb>>(const Scene&, const RunControl&);

}  // namespace shakebed::simulator
