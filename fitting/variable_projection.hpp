#pragma once

#include "fitting/least_squares.hpp"

namespace shakebed::fitting {

struct Projection {
  double nonlinear;
  std::vector<double> coefficients;  ///< of the basis functions
  double chi_squared;
};

/// The best linear coefficients for one value of the nonlinear parameter.
Projection project(const Model& model, const Observations& data, double nonlinear);

/// The least chi^2 over the whole search interval of the nonlinear parameter: 200 trials, then
/// Brent's method around the best one. Throws Error(failed) when the best trial is an end of the
/// interval (the data do not have the model's shape).
Projection minimise_projection(const Model& model, const Observations& data);

}  // namespace shakebed::fitting
