#pragma once

#include "fitting/networks/force_fit.hpp"

// What the two methods of force_fit.hpp share.
namespace shakebed::fitting::networks {

std::string reason_not_to_fit(const ForceHistogram& histogram, Form form);

/// q_k, the share of forces that the law puts into a bin; the last bin is open.
double bin_fraction(const ForceLaw& law, const ForceHistogram& histogram, std::size_t bin);

/// sum_k (n_k - n q_k)^2 / (n q_k), of the law as it stands, normalised or not.
double chi_squared(const ForceLaw& law, const ForceHistogram& histogram);

/// sum of ln(P(f_i) / integral of P) over f_i >= 0.
double log_likelihood(const ForceLaw& law, std::span<const double> f);

}  // namespace shakebed::fitting::networks
