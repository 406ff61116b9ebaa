#pragma once

#include <cmath>

#include "simulator/record.hpp"

namespace shakebed::sweeps {

/// 100 (x/x_0 - 1) and its standard error, the two being independent.
inline simulator::Estimate bias_percent(const simulator::Estimate& x,
                                        const simulator::Estimate& reference) {
  const double ratio = x.mean / reference.mean;
  const double error = std::abs(ratio) * std::hypot(x.standard_error / x.mean,
                                                    reference.standard_error / reference.mean);
  return {100 * (ratio - 1), 100 * error};
}

}  // namespace shakebed::sweeps
