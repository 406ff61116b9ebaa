#pragma once

#include <algorithm>
#include <cmath>

#include "simulator/bed.hpp"
#include "simulator/beds/engines.hpp"

namespace shakebed::simulator {

/// A canonical bed: 100 grains in 5 x 5 d, or 40 in 10 d.
inline Scene canonical(int dimension, double W, double friction, std::uint64_t seed = 1) {
  Scene scene;
  scene.dimension = dimension;
  scene.cell = dimension == 3 ? std::vector<double>{5, 5} : std::vector<double>{10};
  scene.grains = {dimension == 3 ? 100 : 40, 4, 0.9, friction};
  scene.base.drive = {1, std::sqrt(W)};
  scene.base.friction = friction;
  if (friction > 0) scene.contact.tangential = TangentialLaw::viscous_coulomb;
  scene.seed = seed;
  return scene;
}

/// Largest difference between two states, positions by nearest image.
template <class Physics>
double largest_difference(const Physics& physics, const typename Physics::GrainState& a,
                          const typename Physics::GrainState& b) {
  double largest = 0;
  for (int c = 0; c < Physics::dimension; ++c) {
    for (std::size_t i = 0; i < a.count(); ++i) {
      double x = a.position[c][i] - b.position[c][i];
      if (c < Physics::dimension - 1) x += physics.cell.image_shift(c, x);
      largest = std::max({largest, std::abs(x), std::abs(a.velocity[c][i] - b.velocity[c][i])});
    }
  }
  return largest;
}

struct Comparison {
  double difference;
  long contact_steps_uniform;
  long contact_steps_events;
  long collisions_uniform;
  long collisions_events;
  long breaches;
};

/// The uniform engine and `fine` side by side from one bed that has been shaken for some cycles.
template <class Physics>
Comparison fine_against_uniform(const Scene& scene, double cycles) {
  const auto parameters = bind_parameters(scene);
  const auto physics = bind_physics<Physics>(scene, parameters);
  EventEngine<Physics> earlier(physics, parameters, settle<Physics>(scene, {}).grains,
                               ContactOperator::closed);
  earlier.advance(20 * parameters.steps_per_cycle);
  const auto start = earlier.synchronised();
  UniformStepper<Physics> uniform(physics, start);
  EventEngine<Physics> events(physics, parameters, start, ContactOperator::fine);
  const auto steps = std::lround(cycles * static_cast<double>(parameters.steps_per_cycle));
  uniform.advance(steps);
  events.advance(steps);
  return {largest_difference(physics, uniform.synchronised(), events.synchronised()),
          uniform.ledger().contact_steps,
          events.ledger().contact_steps,
          uniform.ledger().collisions,
          events.ledger().collisions,
          events.counters().breaches};
}

}  // namespace shakebed::simulator
