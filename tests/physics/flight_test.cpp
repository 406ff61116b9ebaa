// Free flight z = z_0 + v_0 t - g t^2/2 (velocity Verlet is exact there) and bounces on the base.
#include <catch2/catch.hpp>

#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

template <int D>
simulator::Grains<D, false> one_grain(double height, double vertical_velocity) {
  simulator::Grains<D, false> grain;
  grain.resize_to(1);
  grain.position[D - 1][0] = height;
  grain.velocity[D - 1][0] = vertical_velocity;
  return grain;
}

/// Rebound speed of a grain that touches the still base at unit speed under gravity g, from the
/// driven oscillator delta'' + 2 gamma delta' + omega_0^2 delta = g (Bhateja 2016, Eq. A5, with the
/// weight), delta(0) = 0, delta'(0) = 1, at its next zero.
double rebound_speed(const Material& m, double g) {
  const double t_c = contact_duration(m, Partner::base);
  const double gamma = -std::log(m.restitution) / t_c;
  const double omega = std::numbers::pi / t_c;
  const double a = -g / m.stiffness;
  const double b = (1 + gamma * a) / omega;
  const auto overlap = [&](double t) {
    return std::exp(-gamma * t) * (a * std::cos(omega * t) + b * std::sin(omega * t)) - a;
  };
  double inside = 0.5 * t_c;
  double outside = 1.5 * t_c;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (inside + outside);
    (overlap(middle) > 0 ? inside : outside) = middle;
  }
  const double t = outside;
  return std::exp(-gamma * t) * (gamma * (a * std::cos(omega * t) + b * std::sin(omega * t)) +
                                 omega * (a * std::sin(omega * t) - b * std::cos(omega * t)));
}

/// Height above the touching position to which the grain rises after it has hit the base at unit
/// speed: (v^2/2 + g (z - R))/g once it has left.
template <int D>
double rebound_height(const Material& material, double g, const Entry& entry) {
  const double dt = contact_duration(material, Partner::base) / entry.steps_per_contact;
  // Back along the parabola that reaches z = R at unit speed after the share `phase` of a step.
  const double tau = entry.phase * dt;
  simulator::UniformStepper<Smooth<D>> stepper(
      still_world<Smooth<D>>(material, g, dt),
      one_grain<D>(simulator::grain_radius + tau - g * tau * tau / 2, -1 + g * tau));
  stepper.advance(static_cast<long>(1.6 * entry.steps_per_contact));
  const auto& end = stepper.synchronised();
  const double v = end.velocity[D - 1][0];
  return v * v / (2 * g) + end.position[D - 1][0] - simulator::grain_radius;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("flight: a grain follows its parabola to rounding", "", ((int D), D), 2, 3) {
  constexpr double dt = 1e-3;
  constexpr long steps = 20000;
  constexpr double t = dt * steps;
  auto grain = one_grain<D>(4, 15);
  grain.velocity[0][0] = -0.3;
  simulator::UniformStepper<Smooth<D>> stepper(still_world<Smooth<D>>({}, 1, dt), grain);
  stepper.advance(steps);
  const auto& end = stepper.synchronised();
  // Rounding grows with the number of steps at worst: 20000 x 2e-16 x 110 d.
  CHECK(end.position[D - 1][0] == Approx(4 + 15 * t - t * t / 2).margin(5e-10));
  CHECK(end.velocity[D - 1][0] == Approx(15 - t).margin(5e-11));
  CHECK(end.position[0][0] == Approx(-0.3 * t).margin(5e-11));
  CHECK(end.velocity[0][0] == -0.3);
}

// With k_n = 3e4 the weight matters during the contact: at e = 0.9 it changes the rebound height by
// 1 %, twenty times the margin below.
TEMPLATE_TEST_CASE_SIG("bounce: the rebound height is the driven oscillator's", "", ((int D), D), 2,
                       3) {
  for (const double e : {0.5, 0.9, 1.0}) {
    for (const double g : {1.0, 4.0}) {
      INFO("e = " << e << ", g = " << g);
      const Material material{3e4, e};
      const auto mean = [&](double steps) {
        return entry_phase_average(2000, [&](double phase) {
          return rebound_height<D>(material, g, {phase, steps});
        });
      };
      const double speed = rebound_speed(material, g);
      const double expected = speed * speed / (2 * g);
      const double coarse = mean(50);
      const double fine = mean(100);
      CHECK(fine == Approx(expected).epsilon(2e-3));
      CHECK((4 * fine - coarse) / 3 == Approx(expected).epsilon(5e-4));
    }
  }
}

// e = 1: (v^2/2 + g z) is the same at every apex. The error of one bounce is O(dt^2) and depends on
// the entry phase.
TEST_CASE("bounce: without dissipation the height returns, the better the finer dt") {
  const Material material{1e5, 1};
  const auto worst_change = [&](double steps) {
    const double dt = contact_duration(material, Partner::base) / steps;
    simulator::UniformStepper<Smooth<3>> stepper(still_world<Smooth<3>>(material, 1, dt),
                                                 one_grain<3>(1.5, 0));
    const double energy = stepper.energy();
    double worst = 0;
    long bounces = 0;
    for (long free = 0; bounces < 100; ++free) {
      const long before = stepper.ledger().contact_steps;
      stepper.advance(1);
      if (stepper.ledger().contact_steps != before) continue;
      worst = std::max(worst, std::abs(stepper.energy() - energy));
      bounces = stepper.ledger().collisions;
    }
    return worst;
  };
  const double coarse = worst_change(50);
  CHECK(coarse < 1e-2);
  CHECK(worst_change(200) < coarse / 4);
}

// Impact on a moving base: v' = V + e (V - v) in the limit of a short contact, V the base's
// velocity at the touch (here V_p: the base passes z = 0 upwards at t = 0).
TEST_CASE("bounce: a moving base adds (1 + e) times its velocity") {
  Material material{1e10, 0.8};
  const double dt = contact_duration(material, Partner::base) / 50;
  const double mean = entry_phase_average(200, [&](double phase) {
    auto physics = still_world<Smooth<3>>(material, 1, dt);
    const double V = 3;
    physics.base = {2, V};
    physics.steps_per_cycle = std::lround(2 * std::numbers::pi * 2 / (V * dt));
    const double closing = 1 + V;
    simulator::UniformStepper<Smooth<3>> stepper(
        physics, one_grain<3>(simulator::grain_radius + phase * dt * closing, -1));
    stepper.advance(75);
    return stepper.synchronised().velocity[2][0];
  });
  CHECK(mean == Approx(3 + 0.8 * 4).epsilon(1e-3));
}

}  // namespace shakebed::tests
