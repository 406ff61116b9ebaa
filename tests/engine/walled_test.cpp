#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/motion/dense_engine.hpp"
#include "tests/engine/beds.hpp"

// Beds between walls: the dense stepper over a whole run against uniform stepping, from one bed
// that has been shaken for a while. Both do the same arithmetic on the same grid (velocity Verlet,
// docs/engine.md), so contacts and steps in contact must be the same ones and trajectories agree
// to what chaos makes of rounding: seen 1e-12 to 1e-9 after these steps.
namespace shakebed::simulator {
namespace {

Scene between_walls(int dimension, double gravity, double friction) {
  Scene scene = canonical(dimension, 16, friction);
  scene.gravity = gravity;
  scene.base.restitution = 0.8;
  scene.lid = Scene::Lid{9, true, 0.7, friction};
  scene.contact.stiffness = 1e5;
  return scene;
}

template <class Physics>
void compare(const Scene& scene, long steps) {
  const auto p = bind_parameters(scene);
  const auto physics = bind_physics<Physics>(scene, p);
  DenseEngine<Physics> earlier(physics, settle<Physics>(scene, {}).grains);
  earlier.advance(2 * p.steps_per_cycle);
  const auto start = earlier.synchronised();
  UniformStepper<Physics> uniform(physics, start);
  DenseEngine<Physics> dense(physics, start);
  const double before = dense.energy();
  uniform.advance(steps);
  dense.advance(steps);
  CHECK(dense.ledger().contact_steps == uniform.ledger().contact_steps);
  CHECK(dense.ledger().collisions == uniform.ledger().collisions);
  CHECK(dense.ledger().collisions > 50);
  CHECK(largest_difference(physics, uniform.synchronised(), dense.synchronised()) < 1e-7);
  CHECK(dense.energy() == Approx(uniform.energy()).epsilon(1e-9));
  CHECK(dense.ledger().base_work == Approx(uniform.ledger().base_work).epsilon(1e-7));
  const double gained = dense.energy() - before;
  CHECK(dense.ledger().base_work - dense.ledger().dissipation ==
        Approx(gained).margin(0.02 * dense.ledger().dissipation));
}

}  // namespace

TEST_CASE("Between walls the dense stepper moves grains as the uniform one does") {
  SECTION("a lid that moves, no gravity") {
    compare<WalledPhysics<3, Frictionless>>(between_walls(3, 0, 0), 3000);
  }
  SECTION("a lid that stands still, gravity, friction") {
    auto scene = between_walls(3, 1, 0.4);
    scene.lid->moves_with_base = false;
    compare<WalledPhysics<3, ViscousCoulomb>>(scene, 6000);
  }
  SECTION("side walls in two dimensions, friction") {
    auto scene = between_walls(2, 1, 0.4);
    scene.side_walls = Scene::SideWalls{0.6, 0.3};
    compare<WalledPhysics<2, ViscousCoulomb>>(scene, 3000);
  }
  SECTION("shaken sideways between walls") {
    auto scene = between_walls(3, 1, 0);
    scene.side_walls = Scene::SideWalls{0.6, 0};
    scene.base.direction = DriveDirection::x;
    compare<WalledPhysics<3, Frictionless>>(scene, 3000);
  }
}

}  // namespace shakebed::simulator
