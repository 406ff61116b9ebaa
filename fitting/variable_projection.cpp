#include "fitting/variable_projection.hpp"

#include <cmath>
#include <limits>

#include "files/csv.hpp"
#include "fitting/gsl.hpp"

namespace shakebed::fitting {
namespace {

constexpr std::size_t trials = 200;

struct Scan {
  const Model& model;
  const Observations& data;
  SearchInterval interval;

  double to_parameter(double position) const {
    return interval.logarithmic ? std::exp(position) : position;
  }
  double from() const { return interval.logarithmic ? std::log(interval.from) : interval.from; }
  double to() const { return interval.logarithmic ? std::log(interval.to) : interval.to; }
  double position(std::size_t trial) const {
    return from() + (to() - from()) * double(trial) / double(trials - 1);
  }
  double chi_squared(double at) const { return project(model, data, to_parameter(at)).chi_squared; }
};

double refine(const Scan& scan, double best, double low, double high) {
  gsl_function objective;
  objective.function = [](double at, void* self) {
    return static_cast<const Scan*>(self)->chi_squared(at);
  };
  objective.params = const_cast<Scan*>(&scan);
  const auto minimiser =
      gsl::owned<gsl::Minimiser>(gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent));
  if (gsl_min_fminimizer_set(minimiser.get(), &objective, best, low, high) != GSL_SUCCESS) {
    return best;  // chi^2 is flat to rounding between the neighbours: the trial is as good as any
  }
  for (int i = 0; i < 200; ++i) {
    if (gsl_min_fminimizer_iterate(minimiser.get()) != GSL_SUCCESS) break;
    const double lower = gsl_min_fminimizer_x_lower(minimiser.get());
    const double upper = gsl_min_fminimizer_x_upper(minimiser.get());
    if (gsl_min_test_interval(lower, upper, 1e-9, 1e-9) == GSL_SUCCESS) break;
  }
  return gsl_min_fminimizer_x_minimum(minimiser.get());
}

}  // namespace

Projection project(const Model& model, const Observations& data, double nonlinear) {
  const std::size_t n = data.size();
  const std::size_t p = model.linear_count;
  const auto basis = gsl::matrix(n, p);
  const auto weights = gsl::vector(n);
  const auto y = gsl::vector(n);
  std::vector<double> row(p);
  for (std::size_t i = 0; i < n; ++i) {
    model.basis(data.x[i], nonlinear, row);
    for (std::size_t j = 0; j < p; ++j) gsl_matrix_set(basis.get(), i, j, row[j]);
    gsl_vector_set(weights.get(), i, data.weights[i]);
    gsl_vector_set(y.get(), i, data.y[i]);
  }
  const auto coefficients = gsl::vector(p);
  const auto covariance = gsl::matrix(p, p);
  const auto work = gsl::owned<gsl::LinearFit>(gsl_multifit_linear_alloc(n, p));
  Projection result{nonlinear, std::vector<double>(p), 0};
  std::size_t rank = 0;
  const int status =
      gsl_multifit_wlinear_tsvd(basis.get(), weights.get(), y.get(), 1e-14, coefficients.get(),
                                covariance.get(), &result.chi_squared, &rank, work.get());
  if (status != GSL_SUCCESS || !std::isfinite(result.chi_squared)) {
    result.chi_squared = std::numeric_limits<double>::infinity();
  }
  for (std::size_t j = 0; j < p; ++j) {
    result.coefficients[j] = gsl_vector_get(coefficients.get(), j);
  }
  return result;
}

Projection minimise_projection(const Model& model, const Observations& data) {
  gsl::quiet();
  const Scan scan{model, data, model.search(data.x)};
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const double chi_squared = scan.chi_squared(scan.position(trial));
    if (chi_squared < least) {
      least = chi_squared;
      best = trial;
    }
  }
  if (best == 0 || best + 1 == trials) {
    throw files::failed(
        "", "the data do not have the shape of " + model.name + ": the best " +
                model.parameters[model.nonlinear] + " lies at the end of its search interval (" +
                files::number_text(scan.interval.from) + " to " +
                files::number_text(scan.interval.to) + "); choose another range or model");
  }
  const double at =
      refine(scan, scan.position(best), scan.position(best - 1), scan.position(best + 1));
  return project(model, data, scan.to_parameter(at));
}

}  // namespace shakebed::fitting
