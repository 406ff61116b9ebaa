#pragma once

#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/motion/events.hpp"

namespace shakebed::simulator {

// Compiled beside the beds that run on them: whoever asks an engine itself (tests do) links these
// instead of compiling them again, which takes longer than most files.
extern template class EventEngine<BedPhysics<2, Frictionless>>;
extern template class EventEngine<BedPhysics<2, ViscousCoulomb>>;
extern template class EventEngine<BedPhysics<3, Frictionless>>;
extern template class EventEngine<BedPhysics<3, ViscousCoulomb>>;

}  // namespace shakebed::simulator
