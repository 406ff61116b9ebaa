// First law: work of the base = dissipation + change of kinetic, potential and elastic energy.
// Positions and dashpot forces are second order in dt, so the ledger's gap is too. Between two
// instants at which nothing touches, no end of the sums adds a term of first order.
#include <catch2/catch.hpp>

#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

simulator::Scene shaken_bed(double fraction) {
  simulator::Scene scene;
  scene.dimension = 3;
  scene.cell = {5, 5};
  scene.grains = {100, 4, 0.9, 0.4};
  scene.base = {{1, std::sqrt(22.36)}, 0.9, 0.4};
  scene.contact.tangential = simulator::TangentialLaw::viscous_coulomb;
  scene.protocol.time_step_fraction = fraction;
  return scene;
}

struct Ledger {
  double work, dissipation, change;
  long collisions;
  double gap() const { return work - dissipation - change; }
};

template <class Stepper>
void advance_until_nothing_touches(Stepper& stepper) {
  for (long before = -1; before != stepper.ledger().contact_steps;) {
    before = stepper.ledger().contact_steps;
    stepper.advance(1);
  }
}

Ledger ledger_of_bed(double fraction, long cycles) {
  const auto scene = shaken_bed(fraction);
  const auto parameters = simulator::bind_parameters(scene);
  simulator::UniformStepper<Rough<3>> stepper(simulator::bind_physics<Rough<3>>(scene, parameters),
                                              simulator::settle<Rough<3>>(scene, {}).grains);
  stepper.advance(5 * parameters.steps_per_cycle);
  advance_until_nothing_touches(stepper);
  stepper.ledger() = {};
  const double before = stepper.energy();
  stepper.advance(cycles * parameters.steps_per_cycle);
  advance_until_nothing_touches(stepper);
  const auto& ledger = stepper.ledger();
  return {ledger.base_work, ledger.dissipation, stepper.energy() - before, ledger.collisions};
}

}  // namespace

TEST_CASE("ledger: a collision's gap shrinks with dt squared") {
  for (const double e : {0.5, 0.9}) {
    for (const double mu : {0.0, 0.4}) {
      for (const Partner partner : {Partner::grain, Partner::base}) {
        const auto gap = [&](double steps) {
          return entry_phase_average(1000, [&](double phase) {
            return collide<Rough<3>>({1e6, e, mu}, partner, {phase, steps, 1}).energy_lost;
          });
        };
        const double coarse = gap(25);
        CHECK(std::abs(coarse) < 1e-2);
        CHECK(coarse / gap(50) == Approx(4).margin(0.4));
      }
    }
  }
}

// In the middle of an elastic contact all of the motion is in the spring, (1/2) k_n delta^2:
// kinetic and stored energy add up to the same at every step, within dt squared.
TEST_CASE("ledger: a spring stores what the motion loses") {
  const Material material{1e6, 1};
  for (const Partner partner : {Partner::grain, Partner::base}) {
    const double dt = contact_duration(material, partner) / 100;
    auto start = collide<Smooth<3>>(material, partner, {0.5, 100}).before;
    simulator::UniformStepper<Smooth<3>> stepper(still_world<Smooth<3>>(material, 0, dt), start);
    const double energy = stepper.energy();
    CHECK(energy == Approx(0.5 * effective_mass(partner)));
    double least_motion = energy;
    for (int step = 0; step < 110; ++step) {
      stepper.advance(1);
      CHECK(stepper.energy() == Approx(energy).epsilon(2e-3));
      least_motion = std::min(least_motion, stepper.kinetic_energy());
    }
    CHECK(least_motion < 1e-3 * energy);
  }
}

// The paths of two time steps part after a few collisions, so that the gap per collision is
// compared: over some 10^4 collisions it scatters by 1-2 % (its entry phases and speeds are
// random).
TEST_CASE("ledger: a shaken rough bed closes it, with dt squared") {
  const Ledger coarse = ledger_of_bed(0.04, 60);
  const Ledger fine = ledger_of_bed(0.02, 60);
  REQUIRE(fine.collisions > 10000);
  CHECK(fine.work > 0);
  CHECK(std::abs(fine.gap()) < 1e-3 * fine.work);
  const double ratio = coarse.gap() / static_cast<double>(coarse.collisions) /
                       (fine.gap() / static_cast<double>(fine.collisions));
  UNSCOPED_INFO("gap " << coarse.gap() << " and " << fine.gap() << " of work " << fine.work
                       << ", collisions " << coarse.collisions << " and " << fine.collisions);
  CHECK(ratio == Approx(4).margin(0.4));
}

}  // namespace shakebed::tests
