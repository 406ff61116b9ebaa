#include "simulator/scene/step_bias.hpp"

#include <algorithm>
#include <cmath>

namespace shakebed::simulator {
namespace {

bool takes_contacts_closed(const Scene& scene) {
  return !scene.walled() && scene.protocol.engine != Engine::uniform &&
         scene.protocol.contacts != ContactOperator::fine;
}

double apart(double a, double b) { return std::abs(std::log(a / b)); }

/// 1 - e, which is 0 for elastic grains.
double loss(double restitution) { return std::max(1 - restitution, 1e-3); }

}  // namespace

const StepLaw& nearest_step_law(const Scene& scene, const Parameters& parameters) {
  constexpr double another_kind = 100;  // more than any distance in logarithms
  const bool closed = takes_contacts_closed(scene);
  const double W = scene.gravity > 0 ? scene.W() : INFINITY;
  const auto distance = [&](const StepLaw& law) {
    double sum = 0;
    if (law.closed != closed) sum += 4 * another_kind;
    if (law.dimension != scene.dimension) sum += another_kind;
    if (law.rough != parameters.turns_grains) sum += another_kind;
    sum += apart(std::clamp(W, 1e-3, 1e9), law.W) + apart(scene.grains.layers, law.layers) +
           apart(loss(scene.least_restitution()), loss(law.restitution));
    return sum;
  };
  return *std::ranges::min_element(step_laws(), {}, distance);
}

}  // namespace shakebed::simulator
