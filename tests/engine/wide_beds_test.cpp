// Beds too wide to ask every grain about every other: partners are looked for in bins.

#include <catch2/catch.hpp>

#include "simulator/contact/frictionless.hpp"
#include "simulator/contact/viscous_coulomb.hpp"
#include "simulator/grains/random_stream.hpp"
#include "simulator/motion/flight_search.hpp"
#include "tests/engine/beds.hpp"

namespace shakebed::simulator {
namespace {

/// The next touch of grain i before `until`, from look to look; `never` if there is none.
template <class Look>
NextTouch followed(double until, Look look) {
  double from = 0;
  NextTouch next = look(from);
  while (next.recheck < next.time && next.recheck < until) {
    REQUIRE(next.recheck > from);
    from = next.recheck;
    next = look(from);
  }
  if (next.time > until) next.time = never;
  return next;
}

/// Grains close together on a disordered lattice, some of them cells away from where they began.
template <int D>
Flights<D, 0> close_flights(RandomStream& random, const PeriodicCell<D>& cell, std::size_t count) {
  constexpr double spacing = 1.12;
  std::array<std::size_t, D - 1> across;
  for (int c = 0; c < D - 1; ++c) across[c] = static_cast<std::size_t>(cell.width[c] / spacing);
  Flights<D, 0> flights(count, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    Vector<D> x;
    Vector<D> v;
    std::size_t rest = i;
    for (int c = 0; c < D; ++c) {
      const std::size_t place = c < D - 1 ? rest % across[c] : rest;
      if (c < D - 1) rest /= across[c];
      x[c] = spacing * static_cast<double>(place) + 0.1 * random.uniform();
      if (c < D - 1) x[c] += cell.width[c] * std::floor(3 * random.uniform() - 1);
      v[c] = 2 * random.normal();
    }
    flights.set(i, x, v, 0);
  }
  return flights;
}

/// Whoever changes bin looks again; here the partners do not, so that only touches within adjacent
/// bins of a moment are asked for: a short while.
template <int D>
void compare_searches(const PeriodicCell<D>& cell, std::size_t count) {
  RandomStream random(7, RandomPurpose::thermal_velocities);
  const auto flights = close_flights<D>(random, cell, count);
  FlightSearch<D, 0> search(cell, flights);
  for (std::uint32_t i = 0; i < count; ++i) search.enter(i, flights.position_at(i, 0));
  constexpr double until = 0.02;  // at these speeds nobody comes from two bins away
  int touches = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto swept =
        followed(until, [&](double from) { return next_pair_touch(flights, cell, i, from); });
    const auto binned = followed(until, [&](double from) { return search.next_touch(i, from); });
    CHECK((binned.time == swept.time || std::abs(binned.time - swept.time) < 1e-12));
    if (swept.time < never) {
      CHECK(binned.partner == swept.partner);
      ++touches;
    }
    std::vector<std::uint32_t> all;
    std::vector<std::uint32_t> some;
    const Vector<D> x = flights.position_at(i, until);
    for (const double reach : {1.1, 2.7}) {
      find_flights_near(flights, cell, x, until, reach, all);
      search.find_near(x, until, reach, some);
      std::sort(some.begin(), some.end());
      CHECK(some == all);
    }
  }
  CHECK(touches > 30);
}

template <class Physics>
void check_wide(const Scene& scene, double cycles) {
  const auto c = fine_against_uniform<Physics>(scene, cycles);
  INFO("difference " << c.difference);
  CHECK(c.difference < 1e-8);
  CHECK(c.contact_steps_events == c.contact_steps_uniform);
  CHECK(c.collisions_events == c.collisions_uniform);
  CHECK(c.collisions_uniform > 30);
  CHECK(c.breaches == 0);
}

}  // namespace

TEST_CASE("bins find whom a sweep over all grains finds") {
  compare_searches<2>({{60}}, 400);
  compare_searches<3>({{12, 9}}, 500);
  compare_searches<3>({{3, 40}}, 500);  // too narrow for bins in one direction
}

// As in fine_2d_test and fine_3d_test, with bins at work from start to end.
TEST_CASE("fine equals uniform in wide beds") {
  auto wide = canonical(2, 22.36, 0.4);
  wide.cell = {100};
  wide.grains.count = 400;
  check_wide<BedPhysics<2, ViscousCoulomb>>(wide, 0.1);
  auto field = canonical(3, 22.36, 0);
  field.cell = {10, 12};
  field.grains.count = 480;
  check_wide<BedPhysics<3, Frictionless>>(field, 0.1);
}

}  // namespace shakebed::simulator
