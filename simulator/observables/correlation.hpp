#pragma once

#include <span>

#include "simulator/record.hpp"

namespace shakebed::simulator {

struct CorrelatedMean {
  Estimate estimate;
  double correlation_time;  ///< integrated, in entries of the series; 1/2: uncorrelated
  double independent;       ///< entries / (2 correlation_time)
};

/// Mean of a stationary series and its standard error sqrt(2 tau var / n), with the integrated
/// correlation time tau summed over an automatic window (U. Wolff, Comput. Phys. Commun. 156, 143
/// (2004), S = 1.5, with that paper's bias correction). A series that swings from entry to entry (a
/// hopping bed) counts as uncorrelated: the window would close on the first, negative term alone
/// and state errors that are too small. Fewer than four entries: no error (NaN).
CorrelatedMean mean_of_series(std::span<const double> series);

/// The same mean with the largest of the errors found when 1, 2, 4, ... consecutive entries are
/// averaged into one and 30 or more remain. A quantity that jumps from entry to entry and drifts
/// slowly besides closes the window above on the jumps: on smooth grains with e = 0.95 at W = 40 it
/// states 0.75 of the true error, and this 1.0 to 1.2 of it. Correlation time and independent
/// entries follow from that error.
CorrelatedMean cautious_mean_of_series(std::span<const double> series);

/// Probability with which the drift check calls a long stationary series drifting (two-sided,
/// Gaussian); an error estimated from few entries raises it, to about 1e-3 at 32.
inline constexpr double drift_false_alarm = 1e-4;

using MeanOfSeries = CorrelatedMean (*)(std::span<const double>);

/// True when the means of both halves agree within 3.89 sqrt(2) standard errors of the later half,
/// by either estimator above. (Its error serves for both: a jump within the first half would hide
/// in that half's own error.)
bool halves_agree(std::span<const double> series, MeanOfSeries mean_of = mean_of_series);

}  // namespace shakebed::simulator
