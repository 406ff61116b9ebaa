#pragma once

#include "sweeps/collect.hpp"

namespace shakebed::sweeps {

/// Which instants of the beds' series a table holds.
struct SeriesChoice {
  int phases = 20;  ///< equal ones a cycle; a divisor of the 160 that runs record
  double from = 0;  ///< [cycles], both ends included
  double to = 1e9;
};

/// How beds in containers go, instant by instant: the axes' cells, `replicate`, T [cycles], `phase`
/// (T without its whole cycles), every series of the run (simulator/observables/column_series.hpp)
/// and `large_over_centre` [d], the large grain's centre over the small grains' centre of mass.
/// Seven significant digits: these are instants of a chaotic bed, for drawing. Never runs a bed;
/// a sweep without beds in containers is files::Error(bad_input), and so is a number of phases that
/// does not divide those recorded.
Collected collect_series(const Grid& grid, const store::Cache& cache, const SeriesChoice& choice);

}  // namespace shakebed::sweeps
