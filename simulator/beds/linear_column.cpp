#include "simulator/beds/column_engines.hpp"
#include "simulator/column_bed.hpp"
#include "simulator/contact/cundall_strack.hpp"
#include "simulator/contact/linear_overlap.hpp"
#include "simulator/simulate_column.hpp"

namespace shakebed::simulator {

template class ColumnStepper<RoughColumn<LinearOverlap>>;
template class ColumnReference<RoughColumn<LinearOverlap>>;

void run_linear_column(Record& record, const Scene& scene, const RunControl& control) {
  run_column<LinearOverlap>(record, scene, control);
}

}  // namespace shakebed::simulator
