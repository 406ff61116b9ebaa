#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "simulator/boundary/base.hpp"
#include "simulator/grains/random_stream.hpp"

namespace shakebed::tests {

using simulator::sine_cosine_of_cycles;

// Against the C library in long double, for times after 0 (before it, wrapping a double into [0, 1)
// alone costs 3e-16). Errors of both octant polynomials, of 1/sqrt(2) and of the last rounding add
// up to 2.7e-16 at worst: two and a half units of the last place below 1.
TEST_CASE("base: our sine and cosine are right to 3e-16") {
  constexpr long double two_pi = 2 * std::numbers::pi_v<long double>;
  simulator::RandomStream random(1, simulator::RandomPurpose::filling);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double cycles = k < 1600 ? k / 800.0 : 3 * random.uniform();
    const auto ours = sine_cosine_of_cycles(cycles);
    const long double turn = two_pi * (static_cast<long double>(cycles) - std::floor(cycles));
    worst = std::max(worst, static_cast<double>(std::abs(ours.sine - std::sin(turn))));
    worst = std::max(worst, static_cast<double>(std::abs(ours.cosine - std::cos(turn))));
  }
  INFO("worst error " << worst);
  CHECK(worst < 3e-16);
}

TEST_CASE("base: quarters of a cycle are exact") {
  CHECK(sine_cosine_of_cycles(0).sine == 0);
  CHECK(sine_cosine_of_cycles(0).cosine == 1);
  CHECK(sine_cosine_of_cycles(0.25).sine == 1);
  CHECK(sine_cosine_of_cycles(0.25).cosine == 0);
  CHECK(sine_cosine_of_cycles(0.5).sine == 0);
  CHECK(sine_cosine_of_cycles(0.5).cosine == -1);
  CHECK(sine_cosine_of_cycles(0.75).sine == -1);
  CHECK(sine_cosine_of_cycles(1).sine == 0);
}

// z_b = A sin(omega t) and its derivative, by a central difference (error A omega (2 pi h)^2/6).
TEST_CASE("base: its velocity is the derivative of its height") {
  const simulator::BaseMotion base{1.5, 4.5};
  const double omega = 3;
  constexpr double h = 1e-5;
  for (double phase = 0; phase < 1; phase += 0.037) {
    const double time = 2 * std::numbers::pi * 2 * h / omega;
    const double slope = (base.at(phase + h).height - base.at(phase - h).height) / time;
    CHECK(base.at(phase).velocity == Approx(slope).margin(1e-7));
    CHECK(base.at(phase).height ==
          Approx(1.5 * std::sin(2 * std::numbers::pi * phase)).margin(1e-14));
  }
}

}  // namespace shakebed::tests
