#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "fitting/networks/force_fit_parts.hpp"

namespace shakebed::fitting::networks {

namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// ln Z of the law with a = 1, and its derivatives by (b, beta, theta).
struct Normalisation {
  double Z;
  Vector3d gradient;  ///< of Z
  Matrix3d log_hessian;
};

Normalisation normalisation(const ForceLaw& law) {
  const double b = law.b, beta = law.beta, theta = law.theta;
  const auto [M0, M1, M2] = gaussian_moments(beta, theta, 0, infinity);
  const double M0_t = 2 * (M1 - theta * M0), M1_t = 2 * (M2 - theta * M1);
  const double M0_tt = 4 * (M2 - 2 * theta * M1 + theta * theta * M0) - 2 * M0;
  Normalisation found;
  found.Z = 1 / beta - b * M0;
  found.gradient = {-M0, b * M1 - 1 / (beta * beta), -b * M0_t};
  Matrix3d hessian;
  hessian << 0, M1, -M0_t,                              //
      M1, 2 / (beta * beta * beta) - b * M2, b * M1_t,  //
      -M0_t, b * M1_t, -b * M0_tt;
  found.log_hessian =
      hessian / found.Z - found.gradient * found.gradient.transpose() / (found.Z * found.Z);
  return found;
}

/// h = ln(1 - b exp(-(f - theta)^2)): derivatives by b and theta. By f they are minus those by
/// theta, since h depends on f - theta alone.
struct Shape {
  double b, theta, bb, b_theta, theta_theta;
};
Shape shape(const ForceLaw& law, double f) {
  const double x = f - law.theta, e = std::exp(-x * x), e_t = 2 * x * e;
  const double e_tt = (4 * x * x - 2) * e, rest = 1 / (1 - law.b * e);
  const double h_b = -e * rest, h_t = -law.b * e_t * rest;
  return {h_b, h_t, -h_b * h_b, -e_t * rest * rest, -law.b * e_tt * rest - h_t * h_t};
}

/// Score and Hessian of ln L by (b, beta, theta).
struct Slopes {
  Vector3d score = Vector3d::Zero();
  Matrix3d hessian = Matrix3d::Zero();
};
Slopes slopes(const ForceLaw& law, const std::vector<double>& f) {
  Slopes sum;
  double total = 0, b = 0, t = 0, bb = 0, bt = 0, tt = 0;
  for (const double one : f) {
    const Shape h = shape(law, one);
    total += one, b += h.b, t += h.theta, bb += h.bb, bt += h.b_theta, tt += h.theta_theta;
  }
  const auto norm = normalisation(law);
  const auto n = static_cast<double>(f.size());
  sum.score = Vector3d(b, -total, t) - n * norm.gradient / norm.Z;
  sum.hessian << bb, 0, bt, 0, 0, 0, bt, 0, tt;
  sum.hessian -= n * norm.log_hessian;
  return sum;
}

/// The score equations per force in (u, beta, theta), b = 1 - exp(-u), which keeps b < 1.
struct Equations {
  const std::vector<double>& f;
  std::vector<int> free;  ///< of (b, beta, theta)
  ForceLaw law;           ///< supplies those that are held

  ForceLaw at(const gsl_vector* x) const {
    ForceLaw trial = law;
    for (std::size_t p = 0; p < free.size(); ++p) {
      const double value = gsl_vector_get(x, p);
      if (free[p] == 0) trial.b = 1 - std::exp(-value);
      if (free[p] == 1) trial.beta = value;
      if (free[p] == 2) trial.theta = value;
    }
    return trial;
  }
};

int evaluate(const gsl_vector* x, void* data, gsl_vector* score, gsl_matrix* jacobian) {
  const auto& equations = *static_cast<const Equations*>(data);
  const ForceLaw law = equations.at(x);
  if (!(law.beta > 0)) return GSL_EDOM;
  const auto n = static_cast<double>(equations.f.size());
  auto [s, H] = slopes(law, equations.f);
  if (equations.free.front() == 0) {
    const double b_u = 1 - law.b;  // and b_uu = -b_u
    H.row(0) *= b_u;
    H.col(0) *= b_u;
    H(0, 0) -= s[0] * b_u;
    s[0] *= b_u;
  }
  for (std::size_t p = 0; p < equations.free.size(); ++p) {
    if (score != nullptr) gsl_vector_set(score, p, s[equations.free[p]] / n);
    if (jacobian == nullptr) continue;
    for (std::size_t q = 0; q < equations.free.size(); ++q) {
      gsl_matrix_set(jacobian, p, q, H(equations.free[p], equations.free[q]) / n);
    }
  }
  return s.allFinite() ? GSL_SUCCESS : GSL_EDOM;
}
int score_only(const gsl_vector* x, void* data, gsl_vector* score) {
  return evaluate(x, data, score, nullptr);
}
int jacobian_only(const gsl_vector* x, void* data, gsl_matrix* jacobian) {
  return evaluate(x, data, nullptr, jacobian);
}

bool solve(Equations& equations) {
  const std::size_t count = equations.free.size();
  const std::unique_ptr<gsl_multiroot_fdfsolver, decltype(&gsl_multiroot_fdfsolver_free)> solver(
      gsl_multiroot_fdfsolver_alloc(gsl_multiroot_fdfsolver_hybridsj, count),
      gsl_multiroot_fdfsolver_free);
  gsl_multiroot_function_fdf functions{score_only, jacobian_only, evaluate, count, &equations};
  const double start[] = {-std::log1p(-std::min(equations.law.b, 0.99)), equations.law.beta,
                          equations.law.theta};
  std::vector<double> x;
  for (const int p : equations.free) x.push_back(start[p]);
  const auto view = gsl_vector_const_view_array(x.data(), count);
  if (gsl_multiroot_fdfsolver_set(solver.get(), &functions, &view.vector) != GSL_SUCCESS) {
    return false;
  }
  constexpr double tolerance = 1e-10;  // of the score per force
  for (int step = 0; step < 200; ++step) {
    if (gsl_multiroot_test_residual(solver->f, tolerance) == GSL_SUCCESS) break;
    if (gsl_multiroot_fdfsolver_iterate(solver.get()) != GSL_SUCCESS) break;
  }
  equations.law = equations.at(solver->x);
  // The solver may stop for lack of progress at rounding level: judged by what it reached.
  return gsl_multiroot_test_residual(solver->f, 100 * tolerance) == GSL_SUCCESS;
}

MatrixXd chosen(const Matrix3d& full, const std::vector<int>& free) {
  MatrixXd part(free.size(), free.size());
  for (std::size_t p = 0; p < free.size(); ++p) {
    for (std::size_t q = 0; q < free.size(); ++q) part(p, q) = full(free[p], free[q]);
  }
  return part;
}

bool curves_down(const MatrixXd& hessian) {
  return Eigen::LLT<MatrixXd>(-hessian).info() == Eigen::Success;
}

/// Sum over forces of u u^T, u = score of the force; with forces divided by their own mean,
/// u += (f - mean) c / n, where c = -sum f d(score)/df is what the mean does to the whole score.
Matrix3d score_noise(const ForceLaw& law, const std::vector<double>& f, Scale scale) {
  const auto n = static_cast<double>(f.size());
  const auto norm = normalisation(law);
  Vector3d of_mean = Vector3d::Zero();
  double mean = 0;
  for (const double one : f) {
    const Shape h = shape(law, one);
    of_mean += one * Vector3d(h.b_theta, 1, h.theta_theta) / n;
    mean += one / n;
  }
  if (scale == Scale::given) of_mean.setZero();
  Matrix3d noise = Matrix3d::Zero();
  for (const double one : f) {
    const Shape h = shape(law, one);
    const Vector3d u =
        Vector3d(h.b, -one, h.theta) - norm.gradient / norm.Z + (one - mean) * of_mean;
    noise += u * u.transpose();
  }
  return noise;
}

Covariance covariance(const Equations& equations, Scale scale) {
  const auto& free = equations.free;
  const auto norm = normalisation(equations.law);
  const MatrixXd inverse = chosen(slopes(equations.law, equations.f).hessian, free).inverse();
  const MatrixXd noise = chosen(score_noise(equations.law, equations.f, scale), free);
  // a = 1 / Z follows the others.
  MatrixXd by = MatrixXd::Zero(4, static_cast<Eigen::Index>(free.size()));
  for (std::size_t p = 0; p < free.size(); ++p) {
    by(0, p) = -norm.gradient[free[p]] / (norm.Z * norm.Z);
    by(free[p] + 1, p) = 1;
  }
  const MatrixXd full = by * inverse * noise * inverse * by.transpose();
  Covariance found{};
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::size_t q = 0; q < 4; ++q) found[p][q] = full(p, q);
  }
  return found;
}

}  // namespace

ForceFit fit_likelihood(std::span<const double> f, const ForceHistogram& histogram,
                        const ForceFit& by_histogram, Form form, Scale scale) {
  gsl_set_error_handler_off();
  ForceFit fit = by_histogram;
  if (!fit.good()) return fit;
  std::vector<double> forces;
  std::copy_if(f.begin(), f.end(), std::back_inserter(forces), [](double one) { return one >= 0; });

  const ForceLaw start = normalised(std::min(fit.law.b, 0.99), fit.law.beta, fit.law.theta);
  Equations equations{forces, {0, 1}, start};
  if (form == Form::shifted) equations.free.push_back(2);
  bool found = solve(equations);
  constexpr double nearly_one = 1 - 1e-6;
  fit.b_at_bound = false;
  if (!found || equations.law.b > nearly_one) {
    equations.law = start;
    equations.law.b = 1;
    equations.free.erase(equations.free.begin());
    found = solve(equations) && slopes(equations.law, forces).score[0] > 0;
    fit.b_at_bound = true;
  }
  equations.law = normalised(equations.law.b, equations.law.beta, equations.law.theta);
  fit.law = equations.law;
  fit.log_likelihood = log_likelihood(fit.law, forces);
  const double at_start = log_likelihood(start, forces);
  if (!found || !curves_down(chosen(slopes(fit.law, forces).hessian, equations.free)) ||
      (!fit.b_at_bound && fit.log_likelihood < at_start)) {
    fit.failure = "the likelihood has no maximum near the histogram's estimate";
    return fit;
  }
  fit.covariance = covariance(equations, scale);
  fit.chi_squared = chi_squared(fit.law, histogram);
  fit.degrees_of_freedom =
      static_cast<int>(histogram.bins()) - 1 - static_cast<int>(equations.free.size());
  return fit;
}

}  // namespace shakebed::fitting::networks
