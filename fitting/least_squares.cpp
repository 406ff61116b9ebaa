#include "fitting/least_squares.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <cmath>
#include <set>

#include "files/csv.hpp"
#include "fitting/gsl.hpp"
#include "fitting/models/power_law.hpp"
#include "fitting/profile_likelihood.hpp"
#include "fitting/variable_projection.hpp"

namespace shakebed::fitting {
namespace {

using files::number_text;

void check_data(const Model& model, const Observations& data) {
  const std::size_t needed = model.parameters.size() + 1;
  if (data.size() < needed) {
    throw files::bad_input(
        "", std::to_string(data.size()) + (data.size() == 1 ? " point" : " points") + " for the " +
                std::to_string(model.parameters.size()) + " parameters of " + model.name +
                "; expected at least " + std::to_string(needed) + ": widen the range");
  }
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double x = data.x[i];
    const double weight = data.weights[i];
    const std::string place = "at x = " + number_text(x);
    if (!std::isfinite(x) || !std::isfinite(data.y[i])) {
      throw files::bad_input("", "point " + std::to_string(i + 1) + " is not a finite number");
    }
    if (!(weight > 0) || !std::isfinite(weight)) {
      throw files::bad_input("", "weight " + number_text(weight) + " " + place +
                                     "; expected a positive finite number");
    }
    if (model.positive_x && x <= 0) {
      throw files::bad_input("", model.name + " needs x > 0, got a point " + place);
    }
  }
  const std::set<double> distinct(data.x.begin(), data.x.end());
  if (distinct.size() < model.parameters.size()) {
    throw files::bad_input("", "only " + std::to_string(distinct.size()) + " different x for the " +
                                   std::to_string(model.parameters.size()) + " parameters of " +
                                   model.name);
  }
}

double chi_squared_of(const Model& model, const Observations& data,
                      const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double residual = data.y[i] - model.value(data.x[i], values);
    sum += data.weights[i] * residual * residual;
  }
  return sum;
}

/// (J^T W J)^-1 by QR, in the units of the parameters.
SquareMatrix unscaled_covariance(const Model& model, const Observations& data,
                                 const std::vector<double>& values) {
  const std::size_t p = values.size();
  const auto jacobian = gsl::matrix(data.size(), p);
  std::vector<double> row(p);
  for (std::size_t i = 0; i < data.size(); ++i) {
    model.gradient(data.x[i], values, row);
    for (std::size_t j = 0; j < p; ++j) {
      gsl_matrix_set(jacobian.get(), i, j, std::sqrt(data.weights[i]) * row[j]);
    }
  }
  const auto covariance = gsl::matrix(p, p);
  gsl::check(gsl_multifit_nlinear_covar(jacobian.get(), 0, covariance.get()),
             "the covariance of " + model.name);
  SquareMatrix result{p, std::vector<double>(p * p)};
  for (std::size_t i = 0; i < p * p; ++i) {
    result.elements[i] = gsl_matrix_get(covariance.get(), i / p, i % p);
  }
  return result;
}

void scale_covariance(LeastSquaresFit& fit, Scale scale) {
  if (scale == Scale::given) return;
  const double factor = fit.chi_squared / double(fit.degrees_of_freedom);
  for (double& element : fit.covariance.elements) element *= factor;
}

/// 5 to 25 % of plain descents from bad starts end with status "success" at a wrong point, so
/// the descent's answer is believed only where the projection found it too.
void check_polish(const Model& model, const std::vector<double>& projected, double least,
                  const Descent& polished, const LeastSquaresFit& fit) {
  bool stayed = polished.chi_squared <= least * (1 + 1e-8) + 1e-300;
  for (std::size_t k = 0; k < projected.size(); ++k) {
    const double allowed = 0.01 * fit.standard_error(k) + 1e-6 * std::abs(projected[k]);
    stayed = stayed && std::abs(polished.values[k] - projected[k]) <= allowed;
  }
  if (!stayed) {
    throw files::failed("", "the Levenberg-Marquardt polish of " + model.name +
                                " left the optimum found by variable projection (chi^2 " +
                                number_text(least) + " -> " + number_text(polished.chi_squared) +
                                "); the data do not determine this model");
  }
}

}  // namespace

double LeastSquaresFit::standard_error(std::size_t parameter) const {
  return std::sqrt(covariance(parameter, parameter));
}

double LeastSquaresFit::correlation(std::size_t one, std::size_t other) const {
  return covariance(one, other) / (standard_error(one) * standard_error(other));
}

double interval_factor(Scale scale, std::size_t degrees_of_freedom) {
  return scale == Scale::given ? gsl_cdf_ugaussian_Pinv(0.975)
                               : gsl_cdf_tdist_Pinv(0.975, double(degrees_of_freedom));
}

double curve_error(const Model& model, const LeastSquaresFit& fit, double x) {
  std::vector<double> slope(fit.values.size());
  model.gradient(x, fit.values, slope);
  double variance = 0;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    for (std::size_t j = 0; j < slope.size(); ++j) {
      variance += slope[i] * fit.covariance(i, j) * slope[j];
    }
  }
  return std::sqrt(std::max(variance, 0.0));
}

LeastSquaresFit fit_least_squares(const Model& model, const Observations& data, Scale scale) {
  gsl::quiet();
  check_data(model, data);
  const Projection projection = minimise_projection(model, data);
  const auto start = model.assemble(projection.nonlinear, projection.coefficients);
  const Descent polished = descend(model, data, start, std::vector<bool>(start.size(), false));

  LeastSquaresFit fit;
  fit.values = polished.values;
  fit.chi_squared = chi_squared_of(model, data, fit.values);
  fit.degrees_of_freedom = data.size() - start.size();
  fit.covariance = unscaled_covariance(model, data, fit.values);
  scale_covariance(fit, scale);
  check_polish(model, start, projection.chi_squared, polished, fit);
  for (double x : data.x) fit.fitted.push_back(model.value(x, fit.values));
  fit.intervals = profile_intervals(model, data, fit, scale);
  return fit;
}

LeastSquaresFit fit_log_log(const Observations& data, Scale scale) {
  gsl::quiet();
  check_data(Model::of<PowerLaw>(), data);
  std::vector<double> ln_x, ln_y;
  for (std::size_t i = 0; i < data.size(); ++i) {
    if (data.y[i] <= 0) {
      throw files::bad_input("", "a log-log fit needs y > 0, got " + number_text(data.y[i]) +
                                     " at x = " + number_text(data.x[i]));
    }
    ln_x.push_back(std::log(data.x[i]));
    ln_y.push_back(std::log(data.y[i]));
  }
  double ln_C = 0, alpha = 0, v00 = 0, v01 = 0, v11 = 0;
  LeastSquaresFit fit;
  gsl::check(gsl_fit_wlinear(ln_x.data(), 1, data.weights.data(), 1, ln_y.data(), 1, data.size(),
                             &ln_C, &alpha, &v00, &v01, &v11, &fit.chi_squared),
             "the straight line through ln y against ln x");
  const double C = std::exp(ln_C);
  fit.values = {C, alpha};
  fit.degrees_of_freedom = data.size() - 2;
  fit.covariance = {2, {C * C * v00, C * v01, C * v01, v11}};
  scale_covariance(fit, scale);
  const double factor = interval_factor(scale, fit.degrees_of_freedom);
  const double of_ln_C = factor * fit.standard_error(0) / C;
  const double of_alpha = factor * fit.standard_error(1);
  fit.intervals = {{C * std::exp(-of_ln_C), C * std::exp(of_ln_C)},
                   {alpha - of_alpha, alpha + of_alpha}};
  for (double x : data.x) fit.fitted.push_back(C * std::pow(x, alpha));
  return fit;
}

}  // namespace shakebed::fitting
