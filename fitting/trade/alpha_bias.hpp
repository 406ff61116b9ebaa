#pragma once

#include <string>
#include <vector>

#include "files/csv.hpp"

namespace shakebed::fitting::trade {

/// The exponent of T_z ~ V_p^alpha over scenes that differ in W alone, at one numerical setting.
struct AlphaBias {
  std::string axis;
  std::string value;
  double alpha;
  double error;       ///< standard error from those of T_z
  double bias;        ///< alpha less the reference's (for k_n: less that of the hardest grains)
  double bias_error;  ///< NaN for the reference itself
};

/// From a trade table (sweeps/trade.hpp): its largest family of scenes that share dimension,
/// roughness, layers, restitution and amplitude, those with W >= 5 (beyond the peak of
/// T_z/(m V_p^2)). ln T_z = c + (alpha/2) ln W, unweighted least squares. Settings that not every
/// scene of the family has are left out. Empty with fewer than three such scenes.
std::vector<AlphaBias> alpha_biases(const files::CsvTable& table);

files::CsvTable alpha_table(const std::vector<AlphaBias>& biases);

}  // namespace shakebed::fitting::trade
