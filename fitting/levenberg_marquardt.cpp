#include <gsl/gsl_blas.h>

#include <cmath>
#include <limits>

#include "fitting/gsl.hpp"
#include "fitting/least_squares.hpp"

namespace shakebed::fitting {
namespace {

struct Problem {
  const Model& model;
  const Observations& data;
  std::vector<double> values;     ///< all parameters; the free ones follow GSL's vector
  std::vector<std::size_t> free;  ///< indices of the free parameters
  std::vector<double> slope;      ///< one row of the Jacobian, all parameters

  void take(const gsl_vector* at) {
    for (std::size_t k = 0; k < free.size(); ++k) values[free[k]] = gsl_vector_get(at, k);
  }
};

int residuals(const gsl_vector* at, void* self, gsl_vector* out) {
  auto& problem = *static_cast<Problem*>(self);
  problem.take(at);
  for (std::size_t i = 0; i < problem.data.size(); ++i) {
    const double residual =
        problem.model.value(problem.data.x[i], problem.values) - problem.data.y[i];
    if (!std::isfinite(residual)) return GSL_EDOM;
    gsl_vector_set(out, i, residual);
  }
  return GSL_SUCCESS;
}

int jacobian(const gsl_vector* at, void* self, gsl_matrix* out) {
  auto& problem = *static_cast<Problem*>(self);
  problem.take(at);
  for (std::size_t i = 0; i < problem.data.size(); ++i) {
    problem.model.gradient(problem.data.x[i], problem.values, problem.slope);
    for (std::size_t k = 0; k < problem.free.size(); ++k) {
      const double slope = problem.slope[problem.free[k]];
      if (!std::isfinite(slope)) return GSL_EDOM;
      gsl_matrix_set(out, i, k, slope);
    }
  }
  return GSL_SUCCESS;
}

}  // namespace

Descent descend(const Model& model, const Observations& data, std::vector<double> start,
                const std::vector<bool>& fixed) {
  gsl::quiet();
  Problem problem{model, data, std::move(start), {}, {}};
  problem.slope.resize(problem.values.size());
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    if (!fixed[k]) problem.free.push_back(k);
  }
  const std::size_t n = data.size();
  const std::size_t p = problem.free.size();

  gsl_multifit_nlinear_fdf system{residuals, jacobian, nullptr, n, p, &problem, 0, 0, 0};
  auto parameters = gsl_multifit_nlinear_default_parameters();
  parameters.trs = gsl_multifit_nlinear_trs_lmaccel;
  const auto work = gsl::owned<gsl::NonlinearFit>(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, p));
  const auto at = gsl::vector(p);
  const auto weights = gsl::vector(n);
  for (std::size_t k = 0; k < p; ++k) gsl_vector_set(at.get(), k, problem.values[problem.free[k]]);
  for (std::size_t i = 0; i < n; ++i) gsl_vector_set(weights.get(), i, data.weights[i]);

  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (gsl_multifit_nlinear_winit(at.get(), weights.get(), &system, work.get()) != GSL_SUCCESS) {
    return {problem.values, infinity, false};
  }
  int reason = 0;
  const int status =
      gsl_multifit_nlinear_driver(200, 1e-11, 1e-11, 0, nullptr, nullptr, &reason, work.get());
  problem.take(gsl_multifit_nlinear_position(work.get()));
  double chi_squared = 0;
  gsl_blas_ddot(gsl_multifit_nlinear_residual(work.get()),
                gsl_multifit_nlinear_residual(work.get()), &chi_squared);
  return {problem.values, chi_squared, status == GSL_SUCCESS};
}

}  // namespace shakebed::fitting
