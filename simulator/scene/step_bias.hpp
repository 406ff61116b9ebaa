#pragma once

#include <string>
#include <vector>

#include "simulator/contact/parameters.hpp"
#include "simulator/scene/scene.hpp"

namespace shakebed::simulator {

/// T_z = T_0 (1 + c (dt/t_c)^2) as measured on one bed, with every contact stepped or with isolated
/// ones in closed form.
struct StepLaw {
  std::string scene;
  bool closed;
  int dimension;
  bool rough;
  double W;
  double layers;
  double restitution;
  double coefficient;  ///< c
  double error;        ///< its standard error
};

/// The rows of data/trade/laws.csv, as they were when the program was configured.
const std::vector<StepLaw>& step_laws();

/// The law of the measured bed most like this one: with the same contacts (stepped or closed),
/// dimension and friction if there is one, and then nearest in log W, log N and log(1 - e).
const StepLaw& nearest_step_law(const Scene& scene, const Parameters& parameters);

}  // namespace shakebed::simulator
