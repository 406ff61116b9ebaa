// More than two bodies at once: nothing here is isolated, so that every operator has to step the
// contacts together, as the uniform engine does.

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/simulate.hpp"
#include "tests/engine/beds.hpp"

namespace shakebed::simulator {
namespace {

using Rough3D = BedPhysics<3, ViscousCoulomb>;

struct Thrown {
  Vector<3> x;
  Vector<3> v;
};

Rough3D::GrainState state_of(const std::vector<Thrown>& grains) {
  Rough3D::GrainState state;
  state.resize_to(grains.size());
  for (std::size_t i = 0; i < grains.size(); ++i) {
    set_row(state.position, i, grains[i].x);
    set_row(state.velocity, i, grains[i].v);
    set_row(state.spin, i, Vector<3>(0, 0.3 * static_cast<double>(i), -0.2));
  }
  return state;
}

/// Runs `grains` for a time by both operators and by uniform stepping; `in_cluster`: as many
/// contacts, none of which may be taken in closed form.
void check(const std::vector<Thrown>& grains, double time, long in_cluster) {
  auto scene = canonical(3, 22.36, 0.4);
  const auto parameters = bind_parameters(scene);
  const auto physics = bind_physics<Rough3D>(scene, parameters);
  const auto start = state_of(grains);
  const auto steps = std::lround(time / physics.time_step);
  UniformStepper<Rough3D> uniform(physics, start);
  uniform.advance(steps);
  CHECK(uniform.ledger().collisions == in_cluster);
  for (const auto contacts : {ContactOperator::fine, ContactOperator::closed}) {
    EventEngine<Rough3D> events(physics, parameters, start, contacts);
    events.advance(steps);
    INFO((contacts == ContactOperator::fine ? "fine" : "closed"));
    CHECK(largest_difference(physics, uniform.synchronised(), events.synchronised()) < 1e-9);
    CHECK(events.ledger().collisions == in_cluster);
    CHECK(events.ledger().contact_steps == uniform.ledger().contact_steps);
    CHECK(events.counters().closed == 0);
    CHECK(events.counters().breaches == 0);
  }
}

}  // namespace

TEST_CASE("two grains strike a third from both sides at one instant") {
  const Vector<3> drift(0.3, 0, 5);
  check({{{2.5, 2.5, 30}, drift},
         {{1.3, 2.5, 30}, drift + Vector<3>(2, 0, 0)},
         {{3.7, 2.5, 30}, drift - Vector<3>(2, 0, 0)}},
        0.2, 2);
}

TEST_CASE("a grain strikes one that almost touches the next") {
  check({{{2.5, 2.5, 30}, {0, 0, 5}},
         {{3.5 + 1e-4, 2.5, 30}, {0, 0, 5}},
         {{1.3, 2.45, 30.1}, {2, 0, 5}}},
        0.2, 2);
}

TEST_CASE("three grains meet at one point") {
  std::vector<Thrown> grains;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2 * M_PI * k / 3;
    const Vector<3> outward(std::cos(angle), std::sin(angle), 0);
    grains.push_back({Vector<3>(2.5, 2.5, 30) + 0.75 * outward, Vector<3>(0, 0, 5) - 2 * outward});
  }
  check(grains, 0.2, 3);
}

// The lower of two is on the base while the upper one arrives.
TEST_CASE("a pair meets on the base") {
  check({{{2.5, 2.5, 1.2}, {0, 0, -3}}, {{2.6, 2.5, 2.23}, {0, 0, -3.2}}}, 0.15, 2);
}

// Five grains fill each layer of this cell of 5 d side by side, and thrown as a plug approach one
// another by less than rounding can tell: about to touch now, and now again. Time has to go on.
TEST_CASE("grains that touch by rounding alone do not stop time") {
  auto scene = canonical(2, 5.6, 0, 1984540740475876);
  scene.cell = {5};
  scene.grains.count = 20;
  scene.contact.stiffness = 112000;
  scene.protocol.cycles = 30;
  scene.protocol.contacts = ContactOperator::closed;
  CHECK_NOTHROW(simulate(scene));
}

}  // namespace shakebed::simulator
