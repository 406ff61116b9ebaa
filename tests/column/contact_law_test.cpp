// g++ 12 warns inside its own AVX-512 intrinsics (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wuninitialized"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/column/physics.hpp"

namespace {

using namespace shakebed::tests;

/// A contact pressed to a constant overlap whose surfaces slip along x at `speed`.
ContactState<double> pressed(double overlap, double speed) {
  return {{0, 0, 1}, overlap, 1, 0.5, {speed, 0, 0}, {0, 0, 0}};
}

constexpr SpringKind dry{1000, 400, 0, 0, 0.3};
const SpringContact<LinearOverlap, CundallStrack> law{dry};

}  // namespace

// Stick, slip, and stick again after reversal: F_t = -k_t v t up to mu F_n; after a reversal at
// the cap F_t = -mu F_n + k_t v (t - t_r) up to the cap on the other side.
TEST_CASE("A spring under constant pressure sticks, slides and sticks again") {
  const double overlap = 0.01, speed = 0.5, dt = 1e-4;
  const double cap = dry.friction * dry.normal_stiffness * overlap;
  const double sticks_for = cap / (dry.tangential_stiffness * speed);
  Triple<double> u{0, 0, 0};
  double t = 0;
  for (; t < 2 * sticks_for; t += dt) {
    const auto f = law(pressed(overlap, speed), u, dt);
    const double expected = std::min(dry.tangential_stiffness * speed * (t + dt), cap);
    REQUIRE(f.tangential_force.x == Approx(-expected).epsilon(1e-12));
    REQUIRE(f.tangential_force.y == 0);
  }
  for (double since = dt; since < 3 * sticks_for; since += dt) {
    const auto f = law(pressed(overlap, -speed), u, dt);
    const double expected = std::min(-cap + dry.tangential_stiffness * speed * since, cap);
    REQUIRE(f.tangential_force.x == Approx(expected).epsilon(1e-9).margin(1e-9));
  }
}

TEST_CASE("Friction is bounded by mu |F_n| also with a tangential dashpot, and u by the cap") {
  const SpringKind wet{1000, 400, 0, 60, 0.3};
  const SpringContact<LinearOverlap, CundallStrack> damped{wet};
  Triple<double> u{0, 0, 0};
  const double cap = 0.3 * 1000 * 0.01;
  for (int step = 0; step < 200; ++step) {
    const auto f = damped(pressed(0.01, 2), u, 1e-3);
    REQUIRE(f.tangential_force.x == Approx(-cap).epsilon(1e-12));
    // F_t = -k_t u - gamma_t m_eff v_t must give the truncated force back.
    REQUIRE(-400 * u.x - 60 * 0.5 * 2 == Approx(-cap).epsilon(1e-12));
  }
}

TEST_CASE("The spring stays in the tangent plane while the contact turns") {
  Triple<double> u{0, 0, 0};
  law(pressed(0.01, 0.5), u, 1e-3);
  for (int step = 1; step <= 100; ++step) {
    const double angle = 0.01 * step;
    const Triple<double> n{std::sin(angle), 0, std::cos(angle)};
    const ContactState<double> still{n, 0.01, 1, 0.5, {0, 0, 0}, {0, 0, 0}};
    law(still, u, 1e-3);
    REQUIRE(std::abs(dot(u, n)) < 1e-18);
  }
}

TEST_CASE("Exchanging the grains reverses the force, keeps the moment and the sign of -u") {
  Triple<double> u{0.0004, -0.0002, 0};
  Triple<double> minus_u{-u.x, -u.y, -u.z};
  const ContactState<double> seen_from_i{{0, 0, 1},          0.01, 1, 0.5, {0.2, -0.1, 0.3},
                                         {0.05, 0.07, -0.02}};
  ContactState<double> seen_from_j = seen_from_i;
  seen_from_j.normal = {0, 0, -1};
  seen_from_j.velocity = {-0.2, 0.1, -0.3};
  const auto fi = law(seen_from_i, u, 1e-4);
  const auto fj = law(seen_from_j, minus_u, 1e-4);
  CHECK(fi.force.x == -fj.force.x);
  CHECK(fi.force.y == -fj.force.y);
  CHECK(fi.force.z == -fj.force.z);
  CHECK(fi.moment.x == fj.moment.x);
  CHECK(fi.moment.y == fj.moment.y);
  CHECK(u.x == -minus_u.x);
  CHECK(u.y == -minus_u.y);
}

// Sun 2006, Eqs. 9 and 10; table I gives 0.9 and 0.86. Large-wall contacts are close to
// over-damped.
TEST_CASE("Restitution and duration of table I's contacts") {
  const double large = sphere_mass(3.16, 13.54 / (6 / std::numbers::pi));
  CHECK(large == Approx(223.7).epsilon(1e-3));
  CHECK(table_grain.restitution(0.5) == Approx(0.905).margin(5e-4));
  CHECK(table_grain.restitution(large / (1 + large)) == Approx(0.869).margin(5e-4));
  CHECK(table_wall.restitution(1) == Approx(0.869).margin(5e-4));
  CHECK(table_wall.restitution(large) == Approx(0.06).margin(5e-3));
  CHECK(table_grain.contact_duration(0.5) == Approx(4.97e-3).epsilon(1e-3));
  CHECK(SpringKind{1e4, 0, 40, 0, 0}.restitution(large) == 0);  // over-damped
}

TEST_CASE("SIMD lanes give what the law gives one contact, bit for bit") {
  Triple<Lanes> u{Lanes(0.0), Lanes(0.0), Lanes(0.0)};
  std::array<Triple<double>, lane_count> single{};
  const SpringContact<HertzOverlap, CundallStrack> hertz{SpringKind{2e5, 6e4, 40, 20, 0.5}};
  for (int step = 0; step < 50; ++step) {
    const auto value = [&](double scale) {
      return Lanes([&](std::size_t k) {
        return scale * (1 + static_cast<double>(k)) + 1e-3 * scale * step;
      });
    };
    const ContactState<Lanes> c{{Lanes(0.6), Lanes(0.0), Lanes(0.8)},
                                value(1e-3),
                                Lanes(1.5),
                                value(0.1),
                                {value(0.1), value(-0.2), value(0.05)},
                                {value(0.03), value(0.02), value(-0.01)}};
    const auto f = hertz(c, u, 1e-4);
    for (std::size_t k = 0; k < lane_count; ++k) {
      const ContactState<double> one{
          {0.6, 0, 0.8},
          c.overlap[k],
          1.5,
          c.effective_mass[k],
          {c.velocity.x[k], c.velocity.y[k], c.velocity.z[k]},
          {c.rim_velocity.x[k], c.rim_velocity.y[k], c.rim_velocity.z[k]}};
      const auto expected = hertz(one, single[k], 1e-4);
      REQUIRE(f.force.x[k] == expected.force.x);
      REQUIRE(f.force.z[k] == expected.force.z);
      REQUIRE(f.moment.y[k] == expected.moment.y);
      REQUIRE(u.x[k] == single[k].x);
    }
  }
}
