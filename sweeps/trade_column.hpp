#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"
#include "sweeps/grid.hpp"
#include "sweeps/store/cache.hpp"

namespace shakebed::sweeps {

// The trade study of a bed in a container. Its transient is what is measured, so that errors come
// from replicates.

/// Adds the settings, `all` of them or a few. Columns of the grid: axis, value.
///   reference   dt = t_c/50
///   dt          value is t_c/dt; 25 is what the axes below have
///   half step   the same with contact laws at velocities half a step late
///   k_n         times the scene's, damping rates changed so that restitution stays
///   list skin   reach of the list of neighbours beyond touch [d]
void add_column_settings(Grid& grid, const simulator::Scene& base, bool all);

/// Slope of the large grain's height over the small grains' centre of mass, both averaged over each
/// cycle, by least squares over the cycles [d/cycle]. NaN without a large grain or with one cycle.
double rise_rate(const simulator::Record& record);

/// One row a setting: rise rate, coordination number Z and height of the small grains' centre of
/// mass h_cm, averaged over all cycles; their bias [%] against the reference (for k_n: against the
/// hardest) with its error from the scatter of the replicates; CPU seconds per 1000 cycles, and
/// what a standard error of the rise rate of 1 % costs.
files::CsvTable column_trade_table(const std::string& scene, const Grid& grid,
                                   const store::Cache& cache, const std::vector<double>& seconds);

}  // namespace shakebed::sweeps
