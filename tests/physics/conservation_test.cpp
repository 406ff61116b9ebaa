// Momentum, angular momentum and energy of pairs and of closed systems.
#include <catch2/catch.hpp>

#include "simulator/grains/random_stream.hpp"
#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

template <int D, bool TurnsGrains>
Vector<D> momentum(const simulator::Grains<D, TurnsGrains>& grains) {
  Vector<D> sum = Vector<D>::Zero();
  for (std::size_t i = 0; i < grains.count(); ++i) sum += row(grains.velocity, i);
  return sum;
}

/// Sum of m r x v + I omega about the origin.
template <int D>
Spin<D> angular_momentum(const simulator::Grains<D, true>& grains) {
  Spin<D> sum = Spin<D>::Zero();
  for (std::size_t i = 0; i < grains.count(); ++i) {
    sum += simulator::moment<D>(row(grains.position, i), row(grains.velocity, i));
    sum += simulator::grain_inertia * row(grains.spin, i);
  }
  return sum;
}

/// Two grains 1.25 d apart along `direction` by way of the periodic images, closing at speed 2.
template <int D>
simulator::Grains<D, false> pair_around(const Vector<D>& centre, const Vector<D>& direction) {
  simulator::Grains<D, false> grains;
  grains.resize_to(2);
  for (const int k : {0, 1}) {
    const double side = k == 0 ? -1 : 1;
    set_row(grains.position, k, Vector<D>(centre + side * 0.625 * direction));
    set_row(grains.velocity, k, Vector<D>(-side * direction));
  }
  return grains;
}

}  // namespace

// Newton's third law across the periodic sides: the pair's momentum stays, and the pair does what
// it does in the middle of the cell.
TEMPLATE_TEST_CASE_SIG("momentum: a pair collides across the periodic sides as inside the cell", "",
                       ((int D), D), 2, 3) {
  const Material material{1e6, 0.9};
  const double dt = contact_duration(material, Partner::grain) / 50;
  const auto physics = still_world<Smooth<D>>(material, 0, dt);
  const auto L = physics.cell.width[0];
  const Vector<D> direction = oblique<D>();

  simulator::UniformStepper<Smooth<D>> inside(
      physics, pair_around<D>(Vector<D>::Constant(L / 2), direction));
  auto split = pair_around<D>(Vector<D>::Constant(L / 2), direction);
  for (int c = 0; c < D - 1; ++c) {
    for (std::size_t i = 0; i < 2; ++i) {  // centre on the corner, each grain in the first cell
      split.position[c][i] += i == 0 ? L / 2 : -L / 2;
    }
  }
  REQUIRE((row(split.position, 1) - row(split.position, 0)).norm() > 2);
  simulator::UniformStepper<Smooth<D>> across(physics, split);
  const auto steps = static_cast<long>(0.3 / dt);
  inside.advance(steps);
  across.advance(steps);

  const auto& a = inside.synchronised();
  const auto& b = across.synchronised();
  CHECK(across.ledger().collisions == 1);
  CHECK((row(b.velocity, 0) - row(b.velocity, 1)).dot(direction) == Approx(-1.8).epsilon(1e-2));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK((row(a.velocity, i) - row(b.velocity, i)).norm() < 1e-9);
  }
  CHECK(momentum(b).norm() < 1e-13);
}

// Internal forces and a frictionless horizontal base leave the lateral momentum alone.
TEMPLATE_TEST_CASE_SIG("momentum: a smooth bed keeps its lateral momentum", "", ((int D), D), 2,
                       3) {
  simulator::Scene scene;
  scene.dimension = D;
  scene.cell.assign(D - 1, 5.0);
  scene.grains.count = D == 2 ? 20 : 100;
  scene.grains.layers = 4;
  scene.base.drive = {1, 4};
  auto bed = simulator::settle<Smooth<D>>(scene, {});
  for (std::size_t i = 0; i < bed.grains.count(); ++i) bed.grains.velocity[0][i] = 0.5;
  const auto parameters = simulator::bind_parameters(scene);
  simulator::UniformStepper<Smooth<D>> stepper(
      simulator::bind_physics<Smooth<D>>(scene, parameters), bed.grains);
  stepper.advance(12 * parameters.steps_per_cycle);
  const auto& end = stepper.synchronised();
  CHECK(stepper.ledger().collisions > 10 * scene.grains.count);
  double spread = 0;
  for (const double v : end.velocity[0]) spread += (v - 0.5) * (v - 0.5);
  CHECK(spread > 0.1);
  CHECK(momentum(end)[0] == Approx(0.5 * scene.grains.count).epsilon(1e-12));
  if (D == 3) CHECK(momentum(end)[1] == Approx(0).margin(1e-10));
}

// Forces act on both grains at lever arm R, though their centres are 2R - delta apart: the law as
// written (Bhateja 2016, Eq. A7) creates the angular momentum integral of delta F_t dt. For a
// sliding contact with e = 1, delta = delta_m sin(pi t/t_c) and k_n delta_m^2 = m_eff v_n^2, so
// that dL = mu m_eff v_n^2 t_c/2, which vanishes with the contact's duration.
TEMPLATE_TEST_CASE_SIG("angular momentum: a rough pair keeps it up to delta F_t", "", ((int D), D),
                       2, 3) {
  constexpr double mu = 0.3;
  for (const double stiffness : {1e6, 1e8}) {
    const Material material{stiffness, 1, mu, 1e9};
    const double created = entry_phase_average(100, [&](double phase) {
      const auto impact = collide<Rough<D>>(material, Partner::grain, {phase, 100, 6});
      const Spin<D> before = angular_momentum<D>(impact.before);
      CHECK(before.norm() > 1);
      return (angular_momentum<D>(impact.after) - before).norm();
    });
    CHECK(created ==
          Approx(mu * 0.5 * contact_duration(material, Partner::grain) / 2).epsilon(5e-3));
  }
}

// Ten rough pairs in no one's way: every pair keeps its momentum through friction, too.
TEST_CASE("momentum: rough collisions keep it") {
  simulator::RandomStream random(3, simulator::RandomPurpose::thermal_velocities);
  for (int k = 0; k < 10; ++k) {
    const auto impact = collide<Rough<3>>({1e6, 0.9, 0.5}, Partner::grain,
                                          {random.uniform(), 50, 4 * random.uniform()});
    CHECK(impact.spin_change.norm() > 1e-3);
    CHECK((momentum(impact.after) - momentum(impact.before)).norm() < 1e-12);
  }
}

}  // namespace shakebed::tests
