// Prediction of the next touch.

#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/grains/random_stream.hpp"
#include "simulator/motion/calendar.hpp"
#include "simulator/motion/next_touch.hpp"

namespace shakebed::simulator {
namespace {

using Flights3 = Flights<3, 0>;

/// First time at which any image of j comes within a diameter of i, by marching in small steps.
double marched_touch(const Flights3& flights, const PeriodicCell<3>& cell, std::size_t i,
                     double until, std::size_t& partner) {
  const double dt = 2e-4;
  for (double t = 0; t < until; t += dt) {
    for (std::size_t j = 0; j < flights.count(); ++j) {
      if (j == i) continue;
      Vector<3> r = flights.position_at(j, t) - flights.position_at(i, t);
      for (int c = 0; c < 2; ++c) r[c] += cell.image_shift(c, r[c]);
      if (r.squaredNorm() < 1) {
        partner = j;
        return t;
      }
    }
  }
  return never;
}

}  // namespace

// |r + u tau| = 1 against brute force, images included: following predictions and re-checks from
// re-check to re-check finds the touch that marching finds.
TEST_CASE("the next pair touch, images re-checked, equals marching") {
  RandomStream random(5, RandomPurpose::thermal_velocities);
  const PeriodicCell<3> cell{{5, 4}};
  int touches = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Flights3 flights(6, 1.0);
    for (std::size_t i = 0; i < 6; ++i) {
      const Vector<3> x(5 * random.uniform(), 4 * random.uniform(),
                        2 + 1.3 * static_cast<double>(i));
      flights.set(i, x, Vector<3>(6 * random.normal(), 6 * random.normal(), 2 * random.normal()),
                  0);
    }
    double from = 0;
    NextTouch next = next_pair_touch(flights, cell, 0, from);
    for (int look = 0; look < 10000 && next.recheck < next.time && next.recheck < 2; ++look) {
      REQUIRE(next.recheck > from);
      from = next.recheck;
      next = next_pair_touch(flights, cell, 0, from);
    }
    std::size_t partner = 0;
    const double marched = marched_touch(flights, cell, 0, 2, partner);
    if (marched == never) {
      CHECK((next.time > 2 || next.recheck >= 2));
      continue;
    }
    ++touches;
    CHECK(next.time == Approx(marched).margin(3e-4));
    CHECK(next.partner == partner);
  }
  CHECK(touches > 10);
}

TEST_CASE("a grain that circles the cell between contacts still collides") {
  // Relative travel of 12.3 cells before the grains are level: no nearest image lasts that long.
  const PeriodicCell<3> cell{{5, 5}};
  Flights3 flights(2, 1.0);
  flights.set(0, Vector<3>(0, 0, 50), Vector<3>(0, 0, 0), 0);
  flights.set(1, Vector<3>(3.5, 0, 60), Vector<3>(61.5 / 9.5, 0, -1), 0);
  double from = 0;
  NextTouch next = next_pair_touch(flights, cell, 0, from);
  int looks = 0;
  while (next.recheck < next.time && looks++ < 1000)
    next = next_pair_touch(flights, cell, 0, next.recheck);
  REQUIRE(next.time < never);
  Vector<3> r = flights.position_at(1, next.time) - flights.position_at(0, next.time);
  for (int c = 0; c < 2; ++c) r[c] += cell.image_shift(c, r[c]);
  CHECK(r.norm() == Approx(1).epsilon(1e-12));
  CHECK(next.time > 8.9);
}

// z0 + v0 t - t^2/2 - R = A sin(omega t), against marching.
TEST_CASE("the next base touch is the first root") {
  RandomStream random(9, RandomPurpose::thermal_velocities);
  for (int trial = 0; trial < 300; ++trial) {
    const double omega = 0.7 + 9 * random.uniform();
    const BaseMotion base{1, omega};
    const double period = 2 * M_PI / omega;
    const double phase = random.uniform();
    const double z0 = 0.5 + base.at(phase).height + 3 * random.uniform();
    const double v0 = 4 * random.normal();
    const double found = next_base_touch(z0, v0, 1, base, phase, period, 0, 50);
    const double dt = 1e-5 * period;
    double marched = 0;
    while (z0 + v0 * marched - 0.5 * marched * marched - 0.5 >
               base.at(phase + marched / period).height &&
           marched < 50) {
      marched += dt;
    }
    INFO("omega " << omega << " phase " << phase << " z0 " << z0 << " v0 " << v0);
    CHECK(found == Approx(marched).margin(2 * dt));
  }
}

TEST_CASE("flights keep their path when the epoch moves, also 1000 d up") {
  Flights3 flights(1, 1.0);
  flights.set(0, Vector<3>(1, 2, 1000), Vector<3>(3, -2, 40), 0.3);
  const Vector<3> x = flights.position_at(0, 10.3);
  for (int k = 0; k < 100; ++k) flights.rebase(0.1);
  CHECK((flights.position_at(0, 0.3) - x).norm() < 1e-9);
  CHECK(flights.velocity_at(0, 0.3)[2] == Approx(40 - 10));
}

TEST_CASE("the calendar hands out the earliest event") {
  RandomStream random(2, RandomPurpose::thermal_velocities);
  Calendar calendar(1000);
  std::vector<double> times(1000, never);
  for (int k = 0; k < 5000; ++k) {
    const auto i = static_cast<std::size_t>(1000 * random.uniform());
    times[i] = random.uniform();
    calendar.set(i, times[i]);
    const auto least = std::min_element(times.begin(), times.end());
    REQUIRE(calendar.earliest().time == *least);
    REQUIRE(calendar.earliest().grain == least - times.begin());
  }
}

}  // namespace shakebed::simulator
