#include "sweeps/cost_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/contact/column_parameters.hpp"
#include "simulator/contact/parameters.hpp"

namespace shakebed::sweeps {
namespace {

using simulator::Scene;

bool rough(const Scene& scene) {
  return scene.contact.tangential != simulator::TangentialLaw::frictionless &&
         scene.grains.friction > 0;
}

struct Node {
  double x;
  double y;
};

/// Straight lines in log x and log y; constant beyond the ends.
template <std::size_t n>
double interpolated(const std::array<Node, n>& nodes, double x) {
  if (x <= nodes.front().x) return nodes.front().y;
  for (std::size_t k = 1; k < n; ++k) {
    if (x > nodes[k].x) continue;
    const double share = std::log(x / nodes[k - 1].x) / std::log(nodes[k].x / nodes[k - 1].x);
    return nodes[k - 1].y * std::pow(nodes[k].y / nodes[k - 1].y, share);
  }
  return nodes.back().y;
}

/// Nanoseconds per grain and step against Gamma: measured for 100 rough grains in 3D with a plain
/// Verlet list. Below Gamma = 1 every grain touches its neighbours all the time.
constexpr std::array<Node, 6> grain_step_nanoseconds{
    {{0.9, 49}, {1.5, 11}, {2, 5.8}, {5.6, 4.4}, {22, 3.4}, {89, 2.7}}};

/// Microseconds per grain and cycle of the event engine against Gamma, which pays for collisions
/// and hardly for steps: measured for 100 rough grains in 3D. Below Gamma = 1 settling is most of
/// it, because the bed is found to be at rest within a few cycles.
constexpr std::array<Node, 6> grain_cycle_microseconds{
    {{0.9, 1500}, {1.4, 500}, {2, 80}, {5.6, 35}, {22, 11}, {89, 4}}};

/// Relative to 4 layers: measured from 1 to 10 layers at Gamma = 44 and 89, to a fifth or a third.
double deeper(double layers) { return std::pow(layers / 4, layers < 4 ? 1.7 : 2.6); }

/// Nanoseconds per grain and step of the dense stepper: where everything touches, which is what
/// beds cost at most; between walls, where grains fly; and in a channel shaken from the side, whose
/// grains lie on its floor.
constexpr double packed_nanoseconds = 25;
constexpr double walled_nanoseconds = 4;
constexpr double channel_nanoseconds = 30;

/// Rough grains collide more and cost more a collision; flat beds have fewer neighbours.
double relative_cost(const Scene& scene) {
  if (scene.dimension == 2) return rough(scene) ? 0.3 : 0.13;
  return rough(scene) ? 1 : 0.45;
}

constexpr std::array<Node, 3> cycles_for_a_percent_rough_3d{{{5.6, 60}, {22, 210}, {89, 1200}}};
constexpr std::array<Node, 3> cycles_for_a_percent_smooth_2d{{{5.6, 900}, {22, 5000}, {89, 18000}}};

/// Cycles after which a bed that cannot leave the base is known to be at rest.
constexpr double cycles_at_rest = 12;

double cycles_for_a_percent(const Scene& scene) {
  const double W = scene.gravity > 0 ? scene.W() : 1e3;
  const double in_3d = interpolated(cycles_for_a_percent_rough_3d, W) * 100 / scene.grains.count;
  const double in_2d = interpolated(cycles_for_a_percent_smooth_2d, W) * 40 / scene.grains.count;
  if (scene.dimension == 3 && rough(scene)) return in_3d;
  if (scene.dimension == 2 && !rough(scene)) return in_2d;
  return std::sqrt(in_3d * in_2d);
}

/// In a container every grain touches others for a third of each cycle: nanoseconds per grain and
/// step, averaged over a cycle of 7601 grains; packing a bed takes about 150 sqrt(d/g).
double column_cpu_seconds(const Scene& scene) {
  constexpr double grain_step = 15e-9;
  constexpr double packing = 150;
  const auto p = simulator::bind_column(scene);
  const double steps = predicted_cycles(scene) * static_cast<double>(p.steps_per_cycle);
  return scene.grains.count * grain_step * (steps + packing / (0.04 * p.contact_duration));
}

/// CPU seconds of a grain in a cycle.
double grain_cycle_seconds(const Scene& scene, double steps) {
  if (scene.walled()) {
    const bool on_floor = scene.gravity > 0 && scene.base.direction != simulator::DriveDirection::z;
    return 1e-9 * (on_floor ? channel_nanoseconds : walled_nanoseconds) * steps;
  }
  const double uniform = 1e-9 * interpolated(grain_step_nanoseconds, scene.Gamma()) * steps;
  if (scene.protocol.engine == simulator::Engine::uniform) return uniform;
  const double events = 1e-6 * interpolated(grain_cycle_microseconds, scene.Gamma()) *
                        relative_cost(scene) * deeper(scene.grains.layers);
  return std::min(events, 1e-9 * packed_nanoseconds * steps);
}

}  // namespace

double predicted_cycles(const Scene& scene) {
  if (!scene.column && scene.never_thrown()) return cycles_at_rest;
  if (scene.protocol.cycles) return static_cast<double>(*scene.protocol.cycles);
  const double percents = scene.protocol.until ? scene.protocol.until->fraction / 0.01 : 1;
  const double wanted = cycles_for_a_percent(scene) / (percents * percents);
  constexpr double fewest = 60;  // an error needs tens of blocks, however loose the aim
  return std::min(std::max(wanted, fewest), static_cast<double>(scene.protocol.at_most));
}

double predicted_cpu_seconds(const Scene& scene) {
  if (scene.column) return column_cpu_seconds(scene);
  const double transient = scene.never_thrown()
                               ? 0
                               : static_cast<double>(scene.protocol.transient.value_or(
                                     simulator::automatic_transient(scene)));
  const double grain_cycles = scene.grains.count * (transient + predicted_cycles(scene));
  const double steps = static_cast<double>(simulator::bind_parameters(scene).steps_per_cycle);
  return grain_cycles * grain_cycle_seconds(scene, steps);
}

}  // namespace shakebed::sweeps
