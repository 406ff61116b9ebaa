#pragma once

#include "fitting/models/algebraic.hpp"
#include "fitting/models/exponential.hpp"
#include "fitting/models/power_law.hpp"
#include "fitting/models/two_power.hpp"

namespace shakebed::fitting {

/// Every model a fit file can name. A new model is one header and one entry here.
inline std::vector<Model> all_models() {
  return {Model::of<PowerLaw>(), Model::of<Algebraic>(), Model::of<Exponential>(),
          Model::of<TwoPower>(), Model::of<TwoPowerScaled>()};
}

}  // namespace shakebed::fitting
