// `fine` integrates the same contacts on the same grid as the uniform engine and flies in between
// exactly, so that trajectories differ by rounding, which collisions amplify (about tenfold each).

#include <catch2/catch.hpp>

#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "tests/engine/beds.hpp"

namespace shakebed::simulator {
namespace {

template <class Law>
void check_fine(double W, double friction, double cycles, double tolerance) {
  const auto c = fine_against_uniform<BedPhysics<3, Law>>(canonical(3, W, friction), cycles);
  INFO("W = " << W << ", friction " << friction << ", difference " << c.difference);
  CHECK(c.difference < tolerance);
  CHECK(c.contact_steps_events == c.contact_steps_uniform);
  CHECK(c.collisions_events == c.collisions_uniform);
  CHECK(c.breaches == 0);
}

}  // namespace

// The longer the run and the denser the bed, the more collisions amplify rounding: the runs are as
// long as chaos leaves room for, and the tolerance at W = 89 is 1e-9 after a whole cycle.
TEST_CASE("fine equals uniform, contact for contact, 3D") {
  for (const double friction : {0.0, 0.4}) {
    const auto check = friction > 0 ? check_fine<ViscousCoulomb> : check_fine<Frictionless>;
    check(89, friction, 1, 1e-9);
    check(22.36, friction, 0.2, 1e-8);
    check(5.6, friction, 0.1, 1e-8);
    check(1.5, friction, 0.08, 1e-8);
    check(0.9, friction, 0.05, 1e-8);
  }
}

}  // namespace shakebed::simulator
