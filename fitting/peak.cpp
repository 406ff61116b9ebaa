#include "fitting/peak.hpp"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "files/csv.hpp"
#include "fitting/gsl.hpp"

namespace shakebed::fitting {
namespace {

struct Vertex {
  double W;
  double height;
  std::size_t points;
  bool refined;
};

std::size_t index_of_highest(const std::vector<double>& y) {
  return std::size_t(std::ranges::max_element(y) - y.begin());
}

/// ln r for lambda = 0, otherwise (r^lambda - 1)/lambda: near r = 1 all the same.
double stretched(double r, double lambda) {
  return std::abs(lambda) < 1e-6 ? std::log(r) : (std::pow(r, lambda) - 1) / lambda;
}
double unstretched(double u, double lambda) {
  return std::abs(lambda) < 1e-6 ? std::exp(u) : std::pow(1 + lambda * u, 1 / lambda);
}

/// y = p_0 + p_1 u + p_2 u^2 with u the stretched W/W_highest over [first, last]; the grid point
/// itself when the curve does not bend down there or the vertex falls outside.
Vertex parabola(const Curve& curve, const std::vector<double>& y, std::size_t highest,
                std::size_t first, std::size_t last, double lambda) {
  const std::size_t n = last - first + 1;
  const auto design = gsl::matrix(n, 3);
  const auto weights = gsl::vector(n);
  const auto values = gsl::vector(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double u = stretched(curve.W[first + i] / curve.W[highest], lambda);
    for (std::size_t j = 0; j < 3; ++j) gsl_matrix_set(design.get(), i, j, std::pow(u, double(j)));
    const double error = curve.error[first + i];
    gsl_vector_set(weights.get(), i, 1 / (error * error));
    gsl_vector_set(values.get(), i, y[first + i]);
  }
  const auto p = gsl::vector(3);
  const auto covariance = gsl::matrix(3, 3);
  const auto work = gsl::owned<gsl::LinearFit>(gsl_multifit_linear_alloc(n, 3));
  double chi_squared = 0;
  gsl::check(gsl_multifit_wlinear(design.get(), weights.get(), values.get(), p.get(),
                                  covariance.get(), &chi_squared, work.get()),
             "the parabola through the peak");
  const double p_0 = gsl_vector_get(p.get(), 0);
  const double p_1 = gsl_vector_get(p.get(), 1);
  const double p_2 = gsl_vector_get(p.get(), 2);
  const double u = -p_1 / (2 * p_2);
  const double W = curve.W[highest] * unstretched(u, lambda);
  if (!(p_2 < 0) || !(W >= curve.W[first] && W <= curve.W[last])) {
    return {curve.W[highest], y[highest], 1, false};
  }
  return {W, p_0 + p_1 * u / 2, n, true};
}

Vertex vertex(const Curve& curve, const std::vector<double>& y, double depth, double lambda) {
  const std::size_t highest = index_of_highest(y);
  if (highest == 0 || highest + 1 == y.size()) return {curve.W[highest], y[highest], 1, false};
  const double floor = (1 - depth) * y[highest];
  std::size_t first = highest - 1;
  std::size_t last = highest + 1;
  while (first > 0 && y[first] > floor && y[first - 1] > floor) --first;
  while (last + 1 < y.size() && y[last] > floor && y[last + 1] > floor) ++last;
  return parabola(curve, y, highest, first, last, lambda);
}

/// Percentiles and spread of `statistic` over redrawn curves.
std::vector<std::vector<double>> redraw(
    const Curve& curve, std::size_t draws, unsigned long seed, std::size_t outputs,
    const std::function<std::vector<double>(const std::vector<double>&, gsl_rng*)>& statistic) {
  const auto random = gsl::owned<gsl::RandomStream>(gsl_rng_alloc(gsl_rng_mt19937));
  gsl_rng_set(random.get(), seed);
  std::vector<std::vector<double>> samples(outputs);
  std::vector<double> y(curve.y.size());
  for (std::size_t draw = 0; draw < draws; ++draw) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] = curve.y[i] + gsl_ran_gaussian(random.get(), curve.error[i]);
    }
    const auto values = statistic(y, random.get());
    for (std::size_t k = 0; k < outputs; ++k) samples[k].push_back(values[k]);
  }
  return samples;
}

BootstrapEstimate summary(double value, std::vector<double> samples) {
  std::ranges::sort(samples);
  const auto quantile = [&](double share) {
    return gsl_stats_quantile_from_sorted_data(samples.data(), 1, samples.size(), share);
  };
  return {
      value, gsl_stats_sd(samples.data(), 1, samples.size()), {quantile(0.025), quantile(0.975)}};
}

std::size_t first_settled(const std::vector<double>& y, const SettlingRule& rule) {
  const std::size_t n = y.size();
  const std::size_t tail = std::max<std::size_t>(1, std::size_t(std::ceil(rule.tail * double(n))));
  const double level = gsl_stats_mean(y.data() + (n - tail), 1, tail);
  std::size_t first = n;
  while (first > 0 && std::abs(y[first - 1] - level) <= rule.within * std::abs(level)) --first;
  return first;
}

void check_curve(const Curve& curve, const std::string& what) {
  if (curve.y.size() < 3) {
    throw files::bad_input(
        "", what + " needs at least 3 measured points, got " + std::to_string(curve.y.size()));
  }
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    if (!(curve.W[i] > 0) || !std::isfinite(curve.y[i]) || !(curve.error[i] > 0)) {
      throw files::bad_input("", what + ": point " + std::to_string(i + 1) +
                                     " needs W > 0, a finite value and a positive standard error");
    }
  }
}

}  // namespace

std::size_t highest_point(const Curve& curve, std::optional<double> below) {
  if (curve.y.empty()) throw files::bad_input("", "no measured point to look for a peak in");
  const std::size_t highest = index_of_highest(curve.y);
  if (highest == 0 && !below) {
    throw files::bad_input(
        "", "nothing was measured below the highest point (W = " + files::number_text(curve.W[0]) +
                "), so the peak may lie lower; extend the sweep to smaller W");
  }
  return highest;
}

std::size_t first_settled_point(const Curve& curve, const SettlingRule& rule) {
  const std::size_t first = curve.y.empty() ? 0 : first_settled(curve.y, rule);
  if (first == curve.y.size()) {
    throw files::failed("", "the curve does not settle: its last point is not within " +
                                files::number_text(100 * rule.within) +
                                " % of the mean of its last points; extend the sweep to larger W "
                                "or give the end of the range as a number");
  }
  return first;
}

Peak find_peak(const Curve& curve, std::optional<double> below, const PeakRule& rule) {
  gsl::quiet();
  check_curve(curve, "W_f");
  Peak peak;
  peak.highest = highest_point(curve, below);
  const Vertex best = vertex(curve, curve.y, rule.depth, 0);
  peak.points = best.points;
  peak.refined = best.refined;
  const auto samples =
      redraw(curve, rule.draws, rule.seed, 2, [&](const std::vector<double>& y, gsl_rng* random) {
        const double lambda = gsl_ran_flat(random, -rule.stretch, rule.stretch);
        const Vertex drawn = vertex(curve, y, rule.depth, lambda);
        return std::vector<double>{drawn.W, drawn.height};
      });
  peak.W_f = summary(best.W, samples[0]);
  peak.height = summary(best.height, samples[1]);
  if (!best.refined) {
    const std::size_t at = peak.highest;
    const double lower = at > 0 ? curve.W[at - 1] : *below;
    const double upper = at + 1 < curve.W.size() ? curve.W[at + 1] : curve.W[at];
    // a peak anywhere between the neighbours, all equally likely
    peak.W_f = {best.W, (upper - lower) / std::sqrt(12.0), {lower, upper}};
  }
  return peak;
}

Settling find_settling(const Curve& curve, const SettlingRule& rule) {
  gsl::quiet();
  check_curve(curve, "W_2");
  Settling settling;
  settling.first = first_settled_point(curve, rule);
  const auto samples =
      redraw(curve, rule.draws, rule.seed, 1, [&](const std::vector<double>& y, gsl_rng*) {
        const std::size_t first = std::min(first_settled(y, rule), y.size() - 1);
        return std::vector<double>{curve.W[first]};
      });
  settling.W_2 = summary(curve.W[settling.first], samples[0]);
  return settling;
}

}  // namespace shakebed::fitting
