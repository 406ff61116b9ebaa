#include "sweeps/cost_model.hpp"

#include <catch2/catch.hpp>

namespace shakebed::tests {
namespace {

using simulator::Scene;
using sweeps::predicted_cpu_seconds;
using sweeps::predicted_cycles;

Scene bed(double W) {
  Scene scene;
  scene.grains.count = 100;
  scene.grains.layers = 4;
  scene.grains.friction = scene.base.friction = 0.4;
  scene.cell = {5, 5};
  scene.contact.tangential = simulator::TangentialLaw::viscous_coulomb;
  scene.base.drive = {1, std::sqrt(W)};
  scene.protocol.cycles = 1000;
  return scene;
}

TEST_CASE("Dense beds at low W are the dearest, beds at rest are cheap") {
  CHECK(predicted_cpu_seconds(bed(1.5)) > 2 * predicted_cpu_seconds(bed(22)));
  CHECK(predicted_cycles(bed(0.9)) < 100);
}

TEST_CASE("The event engine is cheaper where grains fly") {
  Scene uniform = bed(22);
  uniform.protocol.engine = simulator::Engine::uniform;
  CHECK(predicted_cpu_seconds(uniform) > 5 * predicted_cpu_seconds(bed(22)));
}

TEST_CASE("Cost grows with grains and cycles") {
  const double once = predicted_cpu_seconds(bed(22));
  Scene longer = bed(22);
  longer.protocol.cycles = 10000;
  CHECK(predicted_cpu_seconds(longer) > 8 * once);
  Scene wider = bed(22);
  wider.grains.count = 400;
  wider.cell = {10, 10};
  CHECK(predicted_cpu_seconds(wider) == Approx(4 * once));
}

TEST_CASE("A deep bed costs more a grain, but no more than where everything touches") {
  const auto layers = [](double n, double W) {
    Scene scene = bed(W);
    scene.grains.layers = n;
    scene.grains.count = static_cast<int>(25 * n);
    return predicted_cpu_seconds(scene) / scene.grains.count;
  };
  // Measured at W = 44, microseconds per grain and cycle: 1.6, 9.6, 23, 114, 1100.
  CHECK(layers(1, 44) < 0.2 * layers(4, 44));
  CHECK(layers(6, 44) > 2 * layers(4, 44));
  CHECK(layers(10, 44) > 7 * layers(4, 44));
  CHECK(layers(40, 44) < 300 * layers(4, 44));  // 10^2.6 = 398 without that bound
}

TEST_CASE("Grains that lie in a channel cost more than those that fly under a lid") {
  Scene under_lid = bed(22);
  under_lid.lid.emplace();
  under_lid.lid->height = 12;
  Scene channel = under_lid;
  channel.base.direction = simulator::DriveDirection::x;
  CHECK(predicted_cpu_seconds(channel) > 3 * predicted_cpu_seconds(under_lid));
}

TEST_CASE("Cycles follow the precision asked for, up to the cap") {
  Scene scene = bed(22);
  scene.protocol.cycles.reset();
  scene.protocol.until = Scene::Precision{"T_z", 0.01};
  CHECK(predicted_cycles(scene) == Approx(210).epsilon(0.05));
  scene.protocol.until->fraction = 0.005;
  CHECK(predicted_cycles(scene) == Approx(4 * 210).epsilon(0.05));
  scene.protocol.at_most = 300;
  CHECK(predicted_cycles(scene) == 300);
}

}  // namespace
}  // namespace shakebed::tests
