// A bed that rests, on a still base and on one too slow to throw it.
#include <catch2/catch.hpp>

#include "simulator/simulate.hpp"
#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

simulator::Scene bed(int dimension, bool rough) {
  simulator::Scene scene;
  scene.dimension = dimension;
  scene.cell.assign(dimension - 1, dimension == 2 ? 10.0 : 5.0);
  scene.grains = {dimension == 2 ? 40 : 100, 4, 0.9, rough ? 0.4 : 0.0};
  scene.base = {{1, 1}, 0.9, rough ? 0.4 : 0.0};
  scene.contact.tangential =
      rough ? simulator::TangentialLaw::viscous_coulomb : simulator::TangentialLaw::frictionless;
  return scene;
}

double estimate(const simulator::Record& record, const std::string& name) {
  for (const auto& quantity : record.quantities) {
    if (quantity.name == name) return quantity.estimate.mean;
  }
  return std::nan("");
}

}  // namespace

// Newton: sum of F_base dt = N m g t + change of momentum, to rounding in every single step; and a
// bed at rest loads its base with its weight N m g.
TEMPLATE_TEST_CASE_SIG("rest: the base carries the bed's weight", "", ((int D), D), 2, 3) {
  const auto scene = bed(D, false);
  const auto parameters = simulator::bind_parameters(scene);
  auto physics = simulator::bind_physics<Smooth<D>>(scene, parameters);
  physics.base = {0, 0};
  simulator::UniformStepper<Smooth<D>> stepper(physics,
                                               simulator::settle<Smooth<D>>(scene, {}).grains);
  const auto upward_momentum = [&] {
    double sum = 0;
    for (const double v : stepper.synchronised().velocity[D - 1]) sum += v;
    return sum;
  };
  const double weight = scene.grains.count * scene.gravity;
  const double dt = parameters.time_step;

  // Thrown up at V_p as it leaves settling: the bed falls back and comes to rest.
  const double before = upward_momentum();
  const double first = stepper.base_force();
  double impulse = 0;
  const auto steps = static_cast<long>(20 / dt);
  for (long s = 0; s < steps; ++s) {
    stepper.advance(1);
    impulse += stepper.base_force() * dt;
    if (s % 100 == 99) stepper.damp(0.99);
    if (s == 50) {  // undamped so far: trapezoid, as Verlet kicks half a step at either end
      const double trapezoid = impulse + 0.5 * dt * (first - stepper.base_force());
      CHECK(trapezoid - weight * 51 * dt == Approx(upward_momentum() - before).margin(1e-9));
    }
  }
  double mean = 0;
  for (long s = 0; s < 1000; ++s) {
    stepper.advance(1);
    mean += stepper.base_force() / 1000;
  }
  CHECK(impulse > 0);
  CHECK(stepper.kinetic_energy() < 1e-6);
  CHECK(mean == Approx(weight).epsilon(1e-4));
}

// Gamma = W < 1 at A = d: the bed rides on the base, at w = V_p cos(omega t). Its fluctuations are
// nothing; in the lab frame (m/2) <w^2> = m V_p^2/4 is motion of the bed as a whole. (The contacts'
// own compliance adds 1e-3 of that at k_n = 2e4 m g/d, and in proportion to 1/k_n.)
TEST_CASE("rest: below W = 1 at A = d the temperature is zero, a quarter in the lab frame") {
  for (const int dimension : {2, 3}) {
    for (const bool rough : {false, true}) {
      INFO(dimension << "D " << (rough ? "rough" : "smooth"));
      auto scene = bed(dimension, rough);
      scene.base.drive = {1, std::sqrt(0.9)};
      scene.protocol.cycles = 10;
      const auto record = simulator::simulate(scene);
      CHECK(estimate(record, "T_z_scaled") < 1e-6);
      CHECK(estimate(record, "T_z_scaled") >= 0);
      CHECK(estimate(record, "T_z_lab_scaled") == Approx(0.25).epsilon(2e-3));
      CHECK(record.at_rest);
      CHECK(record.stationary);
    }
  }
}

// ... and above it is not.
TEST_CASE("rest: at W = 3 the bed is thrown") {
  auto scene = bed(2, false);
  scene.base.drive = {1, std::sqrt(3.0)};
  scene.protocol.transient = 10;
  scene.protocol.cycles = 10;
  const auto record = simulator::simulate(scene);
  CHECK(estimate(record, "T_z_scaled") > 1e-3);
  CHECK_FALSE(record.at_rest);
}

}  // namespace shakebed::tests
