#include "simulator/column_bed.hpp"
#include "simulator/contact/cundall_strack.hpp"
#include "simulator/contact/hertz.hpp"
#include "simulator/simulate_column.hpp"

namespace shakebed::simulator {

void run_hertz_column(Record& record, const Scene& scene, const RunControl& control) {
  run_column<HertzOverlap>(record, scene, control);
}

}  // namespace shakebed::simulator
