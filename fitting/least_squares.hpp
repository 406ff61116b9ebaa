#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fitting/models/model.hpp"

namespace shakebed::fitting {

/// What is fitted: x ascending, weights 1/sigma^2, or all 1 when the errors are not used.
struct Observations {
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> weights;
  std::size_t size() const { return x.size(); }
};

/// Row-major, n by n.
struct SquareMatrix {
  std::size_t n = 0;
  std::vector<double> elements;
  double operator()(std::size_t row, std::size_t column) const {
    return elements[row * n + column];
  }
};

/// How the size of the residuals enters the errors.
enum class Scale {
  estimated,  ///< weights are relative: covariance times chi^2/dof, Student's t
  given       ///< weights are 1/sigma^2 with known sigma: covariance as it is, normal distribution
};

/// Ends of a 95 % interval; an end is infinite when the data do not bound the parameter there.
struct Interval {
  double lower;
  double upper;
};

struct LeastSquaresFit {
  std::vector<double> values;  ///< parameters, in the model's printed order
  SquareMatrix covariance;
  std::vector<Interval> intervals;  ///< 95 %, profile likelihood
  std::vector<double> fitted;       ///< the model at each observation
  double chi_squared = 0;           ///< sum of weight * residual^2
  std::size_t degrees_of_freedom = 0;

  double standard_error(std::size_t parameter) const;
  double correlation(std::size_t one, std::size_t other) const;
};

/// Least squares of a separable model. The optimum comes from variable projection: chi^2 minimised
/// over the linear coefficients is a function of one number, scanned over `Model::search` and
/// refined by Brent's method; no start value enters. One Levenberg-Marquardt run with geodesic
/// acceleration from there gives the Jacobian's covariance, and must not leave the optimum.
/// Intervals are profile-likelihood ones: where chi^2, minimised over the other parameters, has
/// grown by t^2_{0.975,dof} chi^2/dof (estimated scale) or 1.96^2 (given scale).
/// Throws Error(bad_input) for too few, equal, non-finite or non-positive data where the model
/// needs more; Error(failed) when the best nonlinear parameter lies at the end of its interval.
LeastSquaresFit fit_least_squares(const Model& model, const Observations& data, Scale scale);

/// ln y = ln C + alpha ln x by linear least squares: parameters C, alpha of the power law, errors
/// by the same rules (exact for alpha; the interval of C is that of ln C). `weights` are those of
/// ln y, that is y^2/sigma^2 or 1. chi_squared is that of ln y; `fitted` is C x^alpha.
LeastSquaresFit fit_log_log(const Observations& data, Scale scale);

/// One Levenberg-Marquardt run from `start` with the parameters where `fixed` is true held.
struct Descent {
  std::vector<double> values;
  double chi_squared;
  bool converged;
};
Descent descend(const Model& model, const Observations& data, std::vector<double> start,
                const std::vector<bool>& fixed);

/// Standard error of the fitted curve at x: sqrt(gradient . covariance . gradient).
double curve_error(const Model& model, const LeastSquaresFit& fit, double x);

/// Half-width of a 95 % interval in standard errors: Student's t or the normal's 1.96.
double interval_factor(Scale scale, std::size_t degrees_of_freedom);

}  // namespace shakebed::fitting
