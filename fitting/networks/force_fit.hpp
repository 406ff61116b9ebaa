#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "fitting/networks/force_histogram.hpp"
#include "fitting/networks/force_law.hpp"

namespace shakebed::fitting::networks {

/// Which form is fitted: Eq. 11 (theta = 0) or Eq. 13 (theta free, lambda absorbed in a).
enum class Form { plain, shifted };

/// What the scale of f is known from. Dividing n forces by their own mean ties the f together (they
/// average to 1), and the parameters come out more certain than n independent f would make them.
enum class Scale {
  sample_mean,  ///< the fitted forces' own mean
  given         ///< a scale from elsewhere, taken as exact
};

using Covariance = std::array<std::array<double, 4>, 4>;

/// Estimates of (a, b, beta, theta), in this order in `covariance`; theta's entries are 0 when it
/// was held at 0, and b's when it ran into its bound. The covariance is that of independent
/// forces (sandwich form, so it does not assume that the law is true). Forces of one snapshot are
/// correlated over 2-3 diameters: the spread over replicas is the honest error of a bed's P(f).
struct ForceFit {
  ForceLaw law;
  Covariance covariance{};
  double chi_squared = 0;  ///< against the histogram's counts, variances from the fitted counts
  int degrees_of_freedom = 0;
  double log_likelihood = 0;  ///< sum of ln P(f) over f >= 0, the law normalised
  bool b_at_bound = false;    ///< b = 1, held there because P would turn negative beyond
  std::string failure;        ///< empty, or why there is no fit; then the rest means nothing

  bool good() const { return failure.empty(); }
  double standard_error(std::size_t parameter) const;
};

/// (a) Weighted nonlinear least squares on the histogram, as Sun 2006 did: minimises
///     sum_k (n_k - n q_k)^2 / (n q_k),   q_k = integral of P over bin k,
/// over a, b and beta (and theta). Weights come from the fitted counts, iterated: with weights
/// 1/n_k from the observed ones beta comes out up to 4 % high. Bins are integrated, not sampled at
/// their centres. Start: variable projection (q is linear in a and a b) over a grid of beta and
/// theta; then Levenberg-Marquardt of GSL with geodesic acceleration.
ForceFit fit_histogram(std::span<const double> f, const ForceHistogram& histogram, Form form,
                       Scale scale);

/// (b) Maximum likelihood on the forces f >= 0 themselves, `a` eliminated by normalisation:
///     ln L = sum_i ln(1 - b exp(-(f_i - theta)^2)) - beta sum_i f_i - n ln Z(b, beta, theta).
/// Solves the score equations by GSL's hybrid method from the estimate on the histogram, and
/// accepts a root only where ln L curves down and is not below its value at the start.
ForceFit fit_likelihood(std::span<const double> f, const ForceHistogram& histogram,
                        const ForceFit& by_histogram, Form form, Scale scale);

/// How a law that was not fitted here (a printed triple, normalised) stands against these forces.
ForceFit compare(const ForceLaw& law, std::span<const double> f, const ForceHistogram& histogram);

}  // namespace shakebed::fitting::networks
