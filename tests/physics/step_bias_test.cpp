// What a finite step does to one collision, averaged over where in a step the touch falls. For weak
// damping the energy lost is that of the closed form times 1 + (11/24) (omega_0 dt)^2, with
// omega_0 dt = pi dt/t_c, in the leapfrog with predicted velocities:
//   a dashpot that acts on v(n - 1/2) + a(n - 1) dt/2 does (1 + theta^2/4) times the work, theta =
//   omega_0 dt: 1 + 3/8 theta^2 from the prediction, 1 - theta^2/8 from the mean of half steps;
//   the contact lasts 1 - theta^2/24 of t_c; a touch at a share phi of a step gives an amplitude of
//   1 + theta^2 (1/4 - phi + phi^2) v^2/omega_0^2 and is parted from alike, which of the loss
//   averages to 1 + theta^2/4: 1/4 - 1/24 + 1/4 = 11/24.
#include <catch2/catch.hpp>

#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

/// The power of dt with which the excess of the loss goes from steps to twice as many.
double local_order(double e, double steps) {
  return std::log2((loss_ratio(e, steps) - 1) / (loss_ratio(e, 2 * steps) - 1));
}

}  // namespace

TEST_CASE("impact: weakly damped, the loss exceeds the closed form's by 11/24 (pi dt/t_c)^2") {
  constexpr double asymptotic = 11 * std::numbers::pi * std::numbers::pi / 24;  // 4.52
  for (const double steps : {100.0, 200.0}) {
    const double excess = (loss_ratio(0.999, steps) - 1) * steps * steps;
    // The next term is of relative order dt/t_c: 0.7 % at 100 steps.
    CHECK(excess == Approx(asymptotic).epsilon(1.0 / steps));
  }
}

TEST_CASE("impact: the order is two, and nearly so only beyond twenty steps") {
  for (const double e : {0.8, 0.9}) {
    INFO("e = " << e);
    CHECK(local_order(e, 50) == Approx(2).margin(0.03));
    CHECK(local_order(e, 20) == Approx(2).margin(0.06));
    CHECK(local_order(e, 5) < 1.85);
    CHECK(local_order(e, 5) > 1.7);
  }
}

}  // namespace shakebed::tests
