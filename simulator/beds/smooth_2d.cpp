#include "simulator/contact/frictionless.hpp"
#include "simulator/run_bed_definition.hpp"

namespace shakebed::simulator {

template class EventEngine<BedPhysics<2, Frictionless>>;
template Record run_bed<BedPhysics<2, Frictionless>>(const Scene&, const RunControl&);

}  // namespace shakebed::simulator
