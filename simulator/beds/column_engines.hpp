#pragma once

#include "simulator/contact/cundall_strack.hpp"
#include "simulator/contact/hertz.hpp"
#include "simulator/contact/linear_overlap.hpp"
#include "simulator/motion/column/reference.hpp"
#include "simulator/motion/column/stepper.hpp"

namespace shakebed::simulator {

template <class Overlap>
using RoughColumn = ColumnPhysics<Overlap, CundallStrack, CundallStrack>;

// As in engines.hpp: whoever moves a column itself links these instead of compiling them again.
extern template class ColumnStepper<RoughColumn<LinearOverlap>>;
extern template class ColumnReference<RoughColumn<LinearOverlap>>;
extern template class ColumnStepper<RoughColumn<HertzOverlap>>;
extern template class ColumnReference<RoughColumn<HertzOverlap>>;

}  // namespace shakebed::simulator
