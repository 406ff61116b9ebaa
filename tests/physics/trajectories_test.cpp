// The stepper, with its list, its leapfrog and its shortcuts, against the plainest integrator. Two
// paths part by rounding alone, at first 1e-16, and every collision stretches that by about ten;
// a lost contact, a wrong image or another force law parts them by 1e-3 at once.
#include <catch2/catch.hpp>

#include "simulator/grains/random_stream.hpp"
#include "tests/physics/plain_integrator.hpp"

namespace shakebed::tests {
namespace {

template <int D>
void compare(const simulator::Scene& scene, double duration) {
  const auto p = simulator::bind_parameters(scene);
  auto start = simulator::settle<Rough<D>>(scene, {}).grains;
  simulator::RandomStream random(5, simulator::RandomPurpose::thermal_velocities);
  for (auto& column : start.spin) {
    for (double& omega : column) omega = 2 * random.normal();
  }
  simulator::UniformStepper<Rough<D>> stepper(simulator::bind_physics<Rough<D>>(scene, p), start);
  PlainIntegrator<D> plain(scene, p, start);
  const auto steps = static_cast<long>(duration / p.time_step);
  stepper.advance(steps);
  for (long s = 0; s < steps; ++s) plain.step();

  const auto& end = stepper.synchronised();
  double apart = 0;
  double turned = 0;
  for (std::size_t i = 0; i < start.count(); ++i) {
    apart = std::max(apart, (row(end.position, i) - plain.x[i]).norm());
    apart = std::max(apart, (row(end.velocity, i) - plain.v[i]).norm());
    apart = std::max(apart, (row(end.spin, i) - plain.omega[i]).norm());
    turned = std::max(turned, row(end.spin, i).norm());
  }
  INFO(stepper.ledger().collisions << " collisions of " << start.count() << " grains");
  CHECK(stepper.ledger().collisions > scene.grains.count);
  CHECK(turned > 0.1);
  CHECK(apart < 1e-5);
}

template <int D>
simulator::Scene bed(std::vector<double> cell, int count, double V_p) {
  simulator::Scene scene;
  scene.dimension = D;
  scene.cell = std::move(cell);
  scene.grains = {count, count / scene.cell_area(), 0.9, 0.4};
  scene.base = {{1, V_p}, 0.8, 0.3};
  scene.contact.tangential = simulator::TangentialLaw::viscous_coulomb;
  return scene;
}

}  // namespace

TEST_CASE("trajectories: the stepper moves a bed as the plainest integrator does") {
  compare<2>(bed<2>({5}, 12, 2), 1.5);
  compare<2>(bed<2>({2.2}, 4, 4), 10);
  compare<3>(bed<3>({3, 3}, 18, 2), 3.6);
  compare<3>(bed<3>({5, 2.5}, 25, 4), 4.5);
}

}  // namespace shakebed::tests
