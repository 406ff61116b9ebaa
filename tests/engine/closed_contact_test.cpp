// A whole contact in one stride against a fine integration of the same contact.
//   delta'' + (c_n/m_eff) delta' + (k_n/m_eff) delta = 0 until delta = 0 again,
//   d(slip)/dt = -(7/2) min(c_t slip, mu |F_n|)/m_eff     (solid spheres; derived in
//   docs/engine.md)

#include <catch2/catch.hpp>
#include <cmath>

#include "simulator/contact/closed_form.hpp"
#include "simulator/contact/sliding_table.hpp"

namespace shakebed::simulator {
namespace {

ContactKind kind_of(double effective_mass, double e, double mu) {
  ContactKind kind{effective_mass, 2e5, 0, 0, mu, e};
  kind.normal_damping = normal_damping_for(e, kind.stiffness, effective_mass);
  kind.tangential_damping = kind.normal_damping;
  return kind;
}

struct Integrated {
  double impulse;
  double displacement;
  double exit_speed;
  double duration;
};

/// Classical Runge-Kutta of overlap, closing speed and slip, straight from the laws of force.
Integrated integrate(const ContactKind& kind, double q, long steps) {
  const double m = kind.effective_mass;
  const double dt = kind.contact_duration() / static_cast<double>(steps);
  struct State {
    double overlap, closing, slip;
  };
  const auto rate = [&](const State& s) {
    const double force = kind.stiffness * s.overlap + kind.normal_damping * s.closing;
    const double friction =
        std::min(kind.tangential_damping * s.slip, kind.friction * std::abs(force));
    return State{s.closing, -force / m, -3.5 * friction / m};
  };
  const auto add = [](const State& a, const State& b, double h) {
    return State{a.overlap + h * b.overlap, a.closing + h * b.closing, a.slip + h * b.slip};
  };
  State s{0, 1, q};
  double displacement = 0;
  for (long k = 0; k < steps; ++k) {
    const auto k1 = rate(s);
    const auto k2 = rate(add(s, k1, dt / 2));
    const auto k3 = rate(add(s, k2, dt / 2));
    const auto k4 = rate(add(s, k3, dt));
    const double before = s.slip;
    s = add(add(add(add(s, k1, dt / 6), k2, dt / 3), k3, dt / 3), k4, dt / 6);
    displacement += dt * (q - 0.5 * (before + s.slip));
  }
  return {(q - s.slip) / 3.5, displacement, -s.closing, kind.contact_duration()};
}

}  // namespace

TEST_CASE("a closed contact's outcome equals a fine integration to 1e-6") {
  for (const double mass : {0.5, 1.0}) {
    for (const double e : {0.3, 0.7, 0.9, 0.99}) {
      for (const double mu : {0.1, 0.4, 1.0}) {
        const auto kind = kind_of(mass, e, mu);
        const ClosedNormal normal(kind);
        const SlidingTable table(kind, normal);
        CHECK(normal.restitution() == Approx(e).epsilon(1e-12));
        for (const double q : {0.0, 0.05, 0.31, 0.77, 1.3, 2.2, 3.9, 8.0, 40.0}) {
          const auto reference = integrate(kind, q, 20000);
          INFO("m_eff " << mass << ", e " << e << ", mu " << mu << ", slip/closing " << q);
          CHECK(table(q).impulse == Approx(reference.impulse).margin(1e-6));
          CHECK(table(q).displacement ==
                Approx(reference.displacement).margin(1e-6 * reference.duration));
          CHECK(normal.restitution() == Approx(reference.exit_speed).margin(1e-8));
        }
      }
    }
  }
}

TEST_CASE("the normal impulse exceeds its final share only while the dashpot pulls") {
  for (const double e : {0.1, 0.5, 0.9, 1.0}) {
    const ClosedNormal normal(kind_of(0.5, e, 0));
    double largest = 0;
    double largest_overlap = 0;
    for (int k = 0; k <= 10000; ++k) {
      const double t = normal.duration() * k / 10000;
      largest = std::max(largest, normal.impulse_fraction(t));
      largest_overlap = std::max(largest_overlap, normal.overlap(t));
    }
    CHECK(normal.largest_impulse_fraction() == Approx(largest).epsilon(1e-6));
    CHECK(normal.largest_overlap() == Approx(largest_overlap).epsilon(1e-6));
    CHECK(normal.impulse_fraction(normal.duration()) == Approx(1));
  }
}

}  // namespace shakebed::simulator
