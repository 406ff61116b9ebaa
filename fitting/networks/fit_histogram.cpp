#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>

#include "fitting/networks/force_fit_parts.hpp"

namespace shakebed::fitting::networks {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_beta = 1e-3;  ///< the law has no integral at beta <= 0

/// q_k and its derivatives by (a, b, beta, theta).
struct Fractions {
  VectorXd q;
  MatrixXd by;  ///< bins x 4
};

Fractions fractions(const ForceLaw& law, const ForceHistogram& histogram) {
  const auto bins = static_cast<Eigen::Index>(histogram.bins());
  const double beta = law.beta;
  Fractions found{VectorXd(bins), MatrixXd(bins, 4)};
  const auto first_moment = [&](double f) {  // minus the antiderivative of f exp(-beta f)
    return std::isinf(f) ? 0 : (f + 1 / beta) / beta * std::exp(-beta * f);
  };
  for (Eigen::Index k = 0; k < bins; ++k) {
    const auto bin = static_cast<std::size_t>(k);
    const double from = histogram.edges[bin];
    const double to = k + 1 == bins ? infinity : histogram.edges[bin + 1];
    const double E0 = (std::exp(-beta * from) - std::exp(-beta * to)) / beta;
    const double E1 = first_moment(from) - first_moment(to);
    const auto [M0, M1, M2] = gaussian_moments(beta, law.theta, from, to);
    found.q[k] = law.a * (E0 - law.b * M0);
    found.by(k, 0) = E0 - law.b * M0;
    found.by(k, 1) = -law.a * M0;
    found.by(k, 2) = law.a * (law.b * M1 - E1);
    found.by(k, 3) = -2 * law.a * law.b * (M1 - law.theta * M0);
  }
  return found;
}

std::array<double*, 4> parameters(ForceLaw& law) { return {&law.a, &law.b, &law.beta, &law.theta}; }

/// The least squares problem at fixed weights, with some of the four parameters free.
struct Problem {
  const ForceHistogram& histogram;
  std::vector<std::size_t> free;
  ForceLaw law;
  VectorXd observed;     ///< n_k / n
  VectorXd root_weight;  ///< sqrt(n / q_k)

  ForceLaw at(const gsl_vector* x) const {
    ForceLaw trial = law;
    for (std::size_t p = 0; p < free.size(); ++p)
      *parameters(trial)[free[p]] = gsl_vector_get(x, p);
    trial.beta = std::max(trial.beta, least_beta);
    return trial;
  }
};

int residuals(const gsl_vector* x, void* data, gsl_vector* out) {
  const auto& problem = *static_cast<const Problem*>(data);
  const auto model = fractions(problem.at(x), problem.histogram);
  for (Eigen::Index k = 0; k < model.q.size(); ++k) {
    gsl_vector_set(out, k, (model.q[k] - problem.observed[k]) * problem.root_weight[k]);
  }
  return GSL_SUCCESS;
}

int jacobian(const gsl_vector* x, void* data, gsl_matrix* out) {
  const auto& problem = *static_cast<const Problem*>(data);
  const auto model = fractions(problem.at(x), problem.histogram);
  for (Eigen::Index k = 0; k < model.q.size(); ++k) {
    for (std::size_t p = 0; p < problem.free.size(); ++p) {
      gsl_matrix_set(out, k, p, model.by(k, problem.free[p]) * problem.root_weight[k]);
    }
  }
  return GSL_SUCCESS;
}

bool levenberg_marquardt(Problem& problem) {
  auto settings = gsl_multifit_nlinear_default_parameters();
  settings.trs = gsl_multifit_nlinear_trs_lmaccel;
  const std::size_t bins = problem.histogram.bins(), free = problem.free.size();
  const std::unique_ptr<gsl_multifit_nlinear_workspace, decltype(&gsl_multifit_nlinear_free)> work(
      gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &settings, bins, free),
      gsl_multifit_nlinear_free);
  gsl_multifit_nlinear_fdf functions{};
  functions.f = residuals;
  functions.df = jacobian;
  functions.n = bins;
  functions.p = free;
  functions.params = &problem;
  std::vector<double> start;
  for (const std::size_t p : problem.free) start.push_back(*parameters(problem.law)[p]);
  const auto view = gsl_vector_const_view_array(start.data(), free);
  if (gsl_multifit_nlinear_init(&view.vector, &functions, work.get()) != GSL_SUCCESS) return false;
  int info = 0;
  const int status =
      gsl_multifit_nlinear_driver(200, 1e-10, 1e-10, 0, nullptr, nullptr, &info, work.get());
  problem.law = problem.at(gsl_multifit_nlinear_position(work.get()));
  // No progress from a start at the bottom, up to rounding, is an arrival.
  return status == GSL_SUCCESS || info == GSL_ENOPROG;
}

/// The best a and b <= 1 for given beta and theta: linear least squares in a and a b.
struct Start {
  ForceLaw law;
  double sum = infinity;
};
Start linear_start(const Problem& problem, double beta, double theta) {
  // With a = 1: q at b = 0, and minus its change per unit of b.
  const auto unit = fractions({1, 0, beta, theta}, problem.histogram);
  MatrixXd columns(unit.q.size(), 2);
  columns.col(0) = problem.root_weight.cwiseProduct(unit.q);
  columns.col(1) = problem.root_weight.cwiseProduct(unit.by.col(1));
  const VectorXd wanted = problem.root_weight.cwiseProduct(problem.observed);
  Eigen::Vector2d best = columns.colPivHouseholderQr().solve(wanted);
  if (best[1] > best[0]) {
    const VectorXd both = columns.col(0) + columns.col(1);
    best.setConstant(both.dot(wanted) / both.squaredNorm());
  }
  if (!(best[0] > 0)) return {};
  return {{best[0], best[1] / best[0], beta, theta}, (columns * best - wanted).squaredNorm()};
}

ForceLaw best_start(const Problem& problem, Form form) {
  constexpr int betas = 30, thetas = 13;
  Start best;
  for (int s = 0; s < betas; ++s) {
    const double beta = 0.2 * std::pow(30.0, s / (betas - 1.0));  // 0.2 ... 6 per mean force
    for (int t = 0; t < (form == Form::shifted ? thetas : 1); ++t) {
      const double theta = form == Form::shifted ? -1 + 0.25 * t : 0;
      const Start trial = linear_start(problem, beta, theta);
      if (trial.sum < best.sum) best = trial;
    }
  }
  return best.law;
}

/// Least squares with weights from the fitted counts, which the fit changes: repeated until it no
/// longer does. False when it does not settle.
bool iterate_weights(Problem& problem) {
  const auto total = static_cast<double>(problem.histogram.total);
  for (int round = 0; round < 100; ++round) {
    const VectorXd q = fractions(problem.law, problem.histogram).q;
    problem.root_weight = (total / q.array().max(0.5 / total)).sqrt();
    ForceLaw before = problem.law;
    if (!levenberg_marquardt(problem)) return false;
    double change = 0;
    for (const std::size_t p : problem.free) {
      change = std::max(change, std::abs(*parameters(problem.law)[p] - *parameters(before)[p]));
    }
    if (change < 1e-7) return true;  // far below any standard error
  }
  return false;
}

/// Sandwich covariance. The noise of n_k / n is multinomial; with forces divided by their own mean
/// it has a second part: a mean too high by the share eps moves f_i to f_i (1 - eps) and the bin's
/// fraction by eps g_k, g_k = [f P(f)] over the bin's ends.
Covariance covariance(const Problem& problem, std::span<const double> f, Scale scale) {
  const auto& histogram = problem.histogram;
  const auto bins = static_cast<Eigen::Index>(histogram.bins());
  const auto model = fractions(problem.law, histogram);
  const auto total = static_cast<double>(histogram.total);
  MatrixXd J(bins, static_cast<Eigen::Index>(problem.free.size()));
  for (std::size_t p = 0; p < problem.free.size(); ++p) J.col(p) = model.by.col(problem.free[p]);
  const MatrixXd S = J.transpose() * model.q.cwiseInverse().asDiagonal();
  const VectorXd of_q = S * model.q;
  MatrixXd noise = S * model.q.asDiagonal() * S.transpose() - of_q * of_q.transpose();

  if (scale == Scale::sample_mean) {
    VectorXd sum = VectorXd::Zero(bins), edge(bins + 1);
    double variance = 0;
    for (const double one : f) {
      if (one < 0) continue;
      const auto above = std::upper_bound(histogram.edges.begin(), histogram.edges.end() - 1, one);
      sum[above - histogram.edges.begin() - 1] += one - 1;
      variance += (one - 1) * (one - 1) / total;
    }
    for (Eigen::Index k = 0; k < bins; ++k) {
      const double from = histogram.edges[static_cast<std::size_t>(k)];
      edge[k] = from * problem.law.density(from);
    }
    edge[bins] = 0;
    const VectorXd of_mean = S * (edge.tail(bins) - edge.head(bins));
    const VectorXd joint = S * (sum / total);
    noise += of_mean * joint.transpose() + joint * of_mean.transpose() +
             variance * of_mean * of_mean.transpose();
  }
  const MatrixXd inverse = (S * J).inverse();
  const MatrixXd free = inverse * noise * inverse / total;
  Covariance full{};
  for (std::size_t p = 0; p < problem.free.size(); ++p) {
    for (std::size_t s = 0; s < problem.free.size(); ++s) {
      full[problem.free[p]][problem.free[s]] = free(p, s);
    }
  }
  return full;
}

}  // namespace

ForceFit fit_histogram(std::span<const double> f, const ForceHistogram& histogram, Form form,
                       Scale scale) {
  gsl_set_error_handler_off();
  ForceFit fit;
  fit.failure = reason_not_to_fit(histogram, form);
  if (!fit.good()) return fit;

  Problem problem{histogram, {0, 1, 2}, {}, {}, {}};
  if (form == Form::shifted) problem.free.push_back(3);
  VectorXd counts(static_cast<Eigen::Index>(histogram.bins()));
  for (std::size_t k = 0; k < histogram.bins(); ++k) {
    counts[static_cast<Eigen::Index>(k)] = static_cast<double>(histogram.counts[k]);
  }
  const auto total = static_cast<double>(histogram.total);
  problem.observed = counts / total;
  problem.root_weight = total * counts.cwiseMax(1).cwiseSqrt().cwiseInverse();
  const ForceLaw start = best_start(problem, form);
  problem.law = start;
  bool settled = iterate_weights(problem);
  if (!settled || problem.law.b > 1) {
    problem.law = start;
    problem.law.b = 1;
    std::erase(problem.free, std::size_t{1});
    settled = iterate_weights(problem);
    fit.b_at_bound = true;
  }
  if (!settled || problem.law.beta <= least_beta || !(problem.law.a > 0)) {
    fit.failure = "least squares on the histogram did not converge";
    return fit;
  }
  fit.law = problem.law;
  fit.covariance = covariance(problem, f, scale);
  fit.chi_squared = chi_squared(fit.law, histogram);
  fit.degrees_of_freedom =
      static_cast<int>(histogram.bins()) - static_cast<int>(problem.free.size());
  fit.log_likelihood = log_likelihood(fit.law, f);
  return fit;
}

}  // namespace shakebed::fitting::networks
