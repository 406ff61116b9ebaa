#pragma once

#include <vector>

#include "simulator/record.hpp"
#include "sweeps/store/table.hpp"

namespace shakebed::sweeps {

/// What one replicate contributes to a mean.
struct Contribution {
  simulator::Estimate estimate;
  double cycles;  ///< measured; its weight
};

struct Combined {
  simulator::Estimate estimate;
  double chi_squared = 0;  ///< of the scatter between replicates against their own errors
  int degrees_of_freedom = 0;
};

/// Means x_r with standard errors s_r from c_r cycles each, r = 1 ... R, independent:
///   x     = sum c_r x_r / sum c_r,
///   s_w^2 = sum c_r^2 s_r^2 / (sum c_r)^2            from within the runs,
///   s_b^2 = sum c_r (x_r - x)^2 / ((R - 1) sum c_r)  from their scatter.
/// With Var x_r ~ 1/c_r both estimate Var x, and chi^2 = (R - 1) s_b^2 / s_w^2 has R - 1 degrees of
/// freedom. The larger one is kept (as the scale factor of the Particle Data Group does), so that
/// beds with several lives, such as a hopping plug near W = 1.4, get honest errors. Weights are
/// cycles and not 1/s_r^2, because estimated errors are correlated with their means.
Combined combine(const std::vector<Contribution>& replicates);

/// The chance that a scatter at least this large comes from errors that are right. Taking s_r as
/// exact makes it slightly too small: for errors from 30 blocks a nominal 1 % alarms in 1.3 %.
double chance_of_scatter(const Combined& combined);

/// Replicates of a point whose T_z or h_cm scatter more than their errors allow are named in the
/// row's reason, at this false-alarm rate a point.
inline constexpr double false_alarm_rate = 0.01;

/// The row of a point: quantities combined, counts summed, overlaps the largest, other scalars
/// averaged; the reason says what is not stationary, at rest, scattered or warned of.
store::TableRow combine_records(const std::vector<simulator::Record>& replicates);

}  // namespace shakebed::sweeps
