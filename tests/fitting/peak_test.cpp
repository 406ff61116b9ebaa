#include "fitting/peak.hpp"

#include <gsl/gsl_statistics_double.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "files/error.hpp"
#include "tests/fitting/table3.hpp"

using namespace shakebed::fitting;
using shakebed::files::Error;

namespace {

/// A curve of Fig. 2's kind: a steep rise from rest at W = 1, a peak, Table III's 2D decay.
double bed(double W) {
  return 0.282 * (1 + 2.07 * std::pow(W, -0.656)) * (1 - std::exp(-1.1 * (W - 1)));
}

/// Where `bed` peaks, by bisection of its slope.
double true_W_f() {
  double low = 1.5, high = 6;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (bed(middle + 1e-5) > bed(middle - 1e-5) ? low : high) = middle;
  }
  return low;
}

Curve measured(double relative_error, gsl_rng* random) {
  Curve curve;
  for (int rpm = 500; rpm <= 4000; rpm += 100) {
    const double W = W_at(rpm);
    const double sigma = relative_error * bed(W);
    curve.W.push_back(W);
    curve.y.push_back(bed(W) + gsl_ran_gaussian(random, sigma));
    curve.error.push_back(sigma);
  }
  return curve;
}

}  // namespace

TEST_CASE("W_f is refined beyond the grid, with an error that holds", "[peak]") {
  const auto random = random_stream(41);
  const double truth = true_W_f();
  const unsigned draws = 200;
  std::vector<double> found, stated;
  unsigned covered = 0, height_covered = 0;
  for (unsigned draw = 0; draw < draws; ++draw) {
    const auto peak = find_peak(measured(0.01, random.get()), W_at(400), {0.02, 2, 400, draw + 1});
    found.push_back(peak.W_f.value);
    stated.push_back(peak.W_f.standard_error);
    covered += truth >= peak.W_f.interval.lower && truth <= peak.W_f.interval.upper;
    height_covered +=
        bed(truth) >= peak.height.interval.lower && bed(truth) <= peak.height.interval.upper;
  }
  const double mean = gsl_stats_mean(found.data(), 1, draws);
  const double spread = gsl_stats_sd(found.data(), 1, draws);
  const double mean_stated = gsl_stats_mean(stated.data(), 1, draws);
  INFO("W_f " << truth << ", found " << mean << " +- " << spread << ", stated +- " << mean_stated
              << ", covered " << covered << " and " << height_covered << " of " << draws);
  // bias below the error of one measurement; the grid's spacing here is 0.6 to 0.8
  CHECK(std::abs(mean - truth) < spread);
  CHECK(std::abs(mean - truth) < 0.1);
  // the bootstrap adds what the shape between grid points leaves open: it may overstate, never
  // understate by much
  CHECK(mean_stated > 0.8 * spread);
  CHECK(mean_stated < 2 * spread);
  // a 95 % interval falls to 90 % of 200 with probability 1e-3
  CHECK(covered >= 180);
}

TEST_CASE("an exact parabola in ln W gives its vertex", "[peak]") {
  Curve curve;
  for (double u = -0.6; u <= 0.61; u += 0.2) {
    curve.W.push_back(3 * std::exp(u));
    curve.y.push_back(0.6 - 0.1 * (u - 0.07) * (u - 0.07));
    curve.error.push_back(0.001);
  }
  const auto peak = find_peak(curve, 1.0);
  CHECK(peak.refined);
  CHECK(peak.W_f.value == Approx(3 * std::exp(0.07)).epsilon(1e-9));
  CHECK(peak.height.value == Approx(0.6).epsilon(1e-9));
}

TEST_CASE("a peak at the edge is not refined, one below the sweep is refused", "[peak]") {
  const Curve falling{{2.0, 2.7, 3.6}, {0.6, 0.5, 0.4}, {0.01, 0.01, 0.01}};
  const auto peak = find_peak(falling, 1.4);
  CHECK_FALSE(peak.refined);
  CHECK(peak.W_f.value == 2.0);
  CHECK(peak.W_f.interval.lower == 1.4);
  CHECK(peak.W_f.interval.upper == 2.7);
  CHECK_THROWS_WITH(find_peak(falling, std::nullopt),
                    Catch::Contains("nothing was measured below the highest point (W = 2)"));
  CHECK_THROWS_WITH(find_peak({{1, 2, 3}, {1, 2, 1}, {0.1, 0, 0.1}}, std::nullopt),
                    Catch::Contains("point 2 needs W > 0, a finite value and a positive"));
}

TEST_CASE("W_2 is the first W after which the curve stays within 5 % of its tail", "[peak]") {
  // last fifth of ten points: the mean of the last two, 1.00; 1.06 is outside, 0.94 too
  const Curve curve{{1, 2, 3, 4, 5, 6, 7, 8, 9, 10},
                    {3, 2, 1.04, 1.06, 0.96, 0.94, 1.045, 1.02, 1.01, 0.99},
                    std::vector<double>(10, 1e-6)};
  const auto settling = find_settling(curve);
  CHECK(settling.first == 6);
  CHECK(settling.W_2.value == 7);
  CHECK(settling.W_2.interval.lower == 7);
  const Curve rising{{1, 2, 3, 4}, {1, 2, 3, 4}, {0.1, 0.1, 0.1, 0.1}};
  CHECK_THROWS_WITH(first_settled_point(rising, {0.05, 0.5, 10, 1}),
                    Catch::Contains("does not settle"));
}
