#include "simulator/beds/column_engines.hpp"
#include "simulator/column_bed.hpp"
#include "simulator/contact/cundall_strack.hpp"
#include "simulator/contact/hertz.hpp"
#include "simulator/simulate_column.hpp"

namespace shakebed::simulator {

template class ColumnStepper<RoughColumn<HertzOverlap>>;
template class ColumnReference<RoughColumn<HertzOverlap>>;

void run_hertz_column(Record& record, const Scene& scene, const RunControl& control) {
  run_column<HertzOverlap>(record, scene, control);
}

}  // namespace shakebed::simulator
