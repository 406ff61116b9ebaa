#include "simulator/contact/frictionless.hpp"
#include "simulator/run_bed_definition.hpp"

namespace shakebed::simulator {

template class EventEngine<BedPhysics<3, Frictionless>>;
template Record run_bed<BedPhysics<3, Frictionless>>(const Scene&, const RunControl&);

}  // namespace shakebed::simulator
