#pragma once

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "fitting/gsl.hpp"
#include "fitting/least_squares.hpp"
#include "fitting/models/all.hpp"

namespace shakebed::fitting {

/// Table III of Bhateja et al. 2016 (doi 10.1063/1.4944795).
struct Table3Row {
  std::string system;
  Model model;
  std::array<double, 3> abc;
};
inline std::vector<Table3Row> table3() {
  return {{"2D rough", Model::of<Algebraic>(), {0.282, 0.656, 2.07}},
          {"2D rough", Model::of<Exponential>(), {0.327, 0.131, 1.022}},
          {"3D rough", Model::of<Algebraic>(), {0.054, 0.622, 7.98}},
          {"3D rough", Model::of<Exponential>(), {0.092, 0.124, 2.695}}};
}

/// W of the canonical sweep at this frequency: d omega^2/g with A = d = 5 mm, g = 9.81 m/s^2.
inline double W_at(double rpm) {
  const double omega = rpm * 2 * std::numbers::pi / 60;
  return 0.005 * omega * omega / 9.81;
}

/// 600 to 4000 rpm, W = 2.01 to 89.43: the canonical sweep past its peak.
inline std::vector<double> W_past_the_peak() {
  std::vector<double> W;
  for (int rpm = 600; rpm <= 4000; rpm += 100) W.push_back(W_at(rpm));
  return W;
}

/// The model at every x with normal errors of `relative_error`; weights are 1/sigma^2.
inline Observations noisy(const Model& model, const std::vector<double>& x,
                          const std::array<double, 3>& truth, double relative_error,
                          gsl_rng* random) {
  Observations data;
  for (double at : x) {
    const double y = model.value(at, truth);
    const double sigma = relative_error * std::abs(y);
    data.x.push_back(at);
    data.y.push_back(y + gsl_ran_gaussian(random, sigma));
    data.weights.push_back(1 / (sigma * sigma));
  }
  return data;
}

inline Observations exact(const Model& model, const std::vector<double>& x,
                          const std::vector<double>& truth) {
  Observations data;
  for (double at : x) {
    data.x.push_back(at);
    data.y.push_back(model.value(at, truth));
    data.weights.push_back(1);
  }
  return data;
}

inline gsl::RandomStream random_stream(unsigned long seed) {
  auto random = gsl::owned<gsl::RandomStream>(gsl_rng_alloc(gsl_rng_mt19937));
  gsl_rng_set(random.get(), seed);
  return random;
}

}  // namespace shakebed::fitting
