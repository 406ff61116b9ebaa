// Sliding impacts. A friction impulse J at the contact changes velocity by J/m and spin by J R/I,
// so the slip velocity by J/m_t with 1/m_t = 1/m_eff (1 + m R^2/I), that is m_t = (2/7) m_eff for
// spheres (I = 2/5 m R^2), between grains as at the base. Bhateja 2016, Eqs. A6-A8; the impulse
// picture is Walton's: Walton & Braun, Acta Mech. 63, 73 (1986).
#include <catch2/catch.hpp>

#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

constexpr double tangential_mass_share = 2.0 / 7;
constexpr double stiff = 1e8;  // the normal turns by v_t t_c during a contact: here 1e-4
constexpr int phases = 400;

/// Normal impulse's magnitude integral of |F_n| dt / (m_eff v_n). |F_n| is what caps friction, and
/// near the end of a contact the dashpot pulls: the grain, fastest where F_n = 0, is slowed from
/// e' v_n to e v_n, with e' the restitution coefficient of a contact ended at zero force,
/// e' = exp[-(gamma/omega)(pi - atan(2 gamma omega/(omega^2 - gamma^2)))] (Schwager & Poeschel,
/// Granular Matter 9, 465 (2007), Eq. 21, gamma < omega).
double normal_impulse(double e) {
  const double gamma_over_omega = -std::log(e) / std::numbers::pi;
  const double zero_force =
      std::exp(-gamma_over_omega *
               (std::numbers::pi -
                std::atan(2 * gamma_over_omega / (1 - gamma_over_omega * gamma_over_omega))));
  return (1 + e) + 2 * (zero_force - e);
}

Partner other(int k) { return k == 0 ? Partner::grain : Partner::base; }

}  // namespace

TEMPLATE_TEST_CASE_SIG("sliding impact: slip and spin change by the Coulomb amount", "",
                       ((int D), D), 2, 3) {
  constexpr double mu = 0.3;
  constexpr double slip = 6;  // > (7/2) mu (1 + e): it slides throughout
  for (const double e : {0.5, 0.9, 1.0}) {
    for (const Partner partner : {other(0), other(1)}) {
      INFO("e = " << e << (partner == Partner::grain ? " grain-grain" : " grain-base"));
      const Material material{stiff, e, mu, 1e9};
      double slip_change = 0;
      for (int k = 0; k < phases; ++k) {
        const auto impact = collide<Rough<D>>(material, partner, {(k + 0.5) / phases, 50, slip});
        const Vector<D> before = slip * cross<D>(unit_slip_spin<D>(impact.normal), impact.normal);
        slip_change += (before - impact.slip).norm() / phases;
        // Slowed along its direction, not turned.
        CHECK(impact.slip.normalized().dot(before.normalized()) == Approx(1).margin(1e-6));
        // I d(omega) = R J, and J is also what the centre gains: to rounding, whatever dt.
        const Vector<D> gain = row(impact.after.velocity, 0) - row(impact.before.velocity, 0);
        const Vector<D> J = gain - gain.dot(impact.normal) * impact.normal;
        const double turned = simulator::grain_inertia * impact.spin_change.norm();
        CHECK(turned == Approx(simulator::grain_radius * J.norm()).epsilon(1e-3));
        // e = 1: nothing pulls, so |J_t| = mu J_n, whatever dt.
        if (e == 1) CHECK(J.norm() == Approx(mu * std::abs(gain.dot(impact.normal))).epsilon(1e-3));
      }
      const double expected = mu * normal_impulse(e) / tangential_mass_share;
      CHECK(slip_change == Approx(expected).epsilon(1e-3));
      // The textbook's (7/2) mu (1 + e) v_n is exact at e = 1, and 0.2 % short at e = 0.9.
      if (e == 0.9) CHECK(slip_change == Approx(3.5 * mu * (1 + e)).epsilon(3e-3));
    }
  }
}

TEST_CASE("sliding impact: spin about the normal stays") {
  const Material material{stiff, 0.9, 0.4};
  const auto impact = collide<Rough<3>>(material, Partner::base, {0.5, 50, 2});
  CHECK(impact.spin_change.dot(impact.normal) == Approx(0).margin(1e-12));
  CHECK(impact.spin_change.norm() > 0.1);
}

// No cap (mu large): m_t ds/dt = -c_t s for the duration t_c, while e = exp(-c_n t_c/(2 m_eff)).
// With c_t = c_n: s'/s = exp(-c_n t_c/((2/7) m_eff)) = e^(2 x 7/2) = e^7.
TEMPLATE_TEST_CASE_SIG("viscous impact: with c_t = c_n the slip decays by e^7", "", ((int D), D), 2,
                       3) {
  for (const double e : {0.5, 0.9, 0.95}) {
    for (const Partner partner : {other(0), other(1)}) {
      INFO("e = " << e << (partner == Partner::grain ? " grain-grain" : " grain-base"));
      const Material material{stiff, e, 1e9};
      const auto left = [&](double steps) {
        return entry_phase_average(phases, [&](double phase) {
          return collide<Rough<D>>(material, partner, {phase, steps, 0.1}).slip.norm() / 0.1;
        });
      };
      const double coarse = left(50);
      const double fine = left(100);
      CHECK((4 * fine - coarse) / 3 == Approx(std::pow(e, 7)).epsilon(1e-3));
      if (e == 0.9) CHECK(fine == Approx(0.478).epsilon(2e-3));
    }
  }
}

// A dashpot strong enough (c_t t_c >> m_t) stops the slip as long as friction can: s_0 <
// (7/2) mu (1 + e) v_n ends in rolling (zero slip), more keeps the rest.
TEST_CASE("rolling threshold: slip below (7/2) mu (1 + e) v_n ends, slip above keeps the rest") {
  constexpr double mu = 0.2;
  for (const double e : {0.9, 1.0}) {
    for (const Partner partner : {other(0), other(1)}) {
      const double steps = 200;
      const double dt = contact_duration({stiff, e}, partner) / steps;
      const double c_t = 0.25 * tangential_mass_share * effective_mass(partner) / dt;
      const Material material{stiff, e, mu, c_t};
      const double threshold = mu * normal_impulse(e) / tangential_mass_share;
      for (const double share : {0.5, 0.9}) {
        const auto impact = collide<Rough<3>>(material, partner, {0.5, steps, share * threshold});
        CHECK(impact.slip.norm() < 0.02 * threshold);
        // J = m_t s_0: each partner of a pair gains J/m = s_0/7, a grain on the base 2 s_0/7.
        const double J = tangential_mass_share * effective_mass(partner) * share * threshold;
        CHECK(simulator::grain_inertia * impact.spin_change.norm() ==
              Approx(simulator::grain_radius * J).epsilon(0.03));
      }
      for (const double share : {1.1, 1.5}) {
        const auto impact = collide<Rough<3>>(material, partner, {0.5, steps, share * threshold});
        CHECK(impact.slip.norm() == Approx((share - 1) * threshold).margin(0.02 * threshold));
      }
    }
  }
}

// A grain set sliding on the base: v = v_0 - mu g t until t = 2 v_0/(7 mu g), then it rolls at
// (5/7) v_0, whatever mu (Coriolis, Theorie mathematique des effets du jeu de billard, 1835).
TEMPLATE_TEST_CASE_SIG("rolling: a sliding grain ends at 5/7 of its speed", "", ((int D), D), 2,
                       3) {
  constexpr double v_0 = 2;
  constexpr double k_n = 1e4;
  for (const double mu : {0.1, 0.4}) {
    const Material material{k_n, 0.9, mu};
    const double dt = contact_duration(material, Partner::base) / 50;
    simulator::Grains<D, true> grain;
    grain.resize_to(1);
    grain.position[D - 1][0] = simulator::grain_radius - 1 / k_n;  // carries its weight
    grain.velocity[0][0] = v_0;
    simulator::UniformStepper<Rough<D>> stepper(still_world<Rough<D>>(material, 1, dt), grain);
    const double rolls_from = 2 * v_0 / (7 * mu);
    const auto sliding = static_cast<long>(0.9 * rolls_from / dt);
    stepper.advance(sliding);
    CHECK(stepper.synchronised().velocity[0][0] ==
          Approx(v_0 - mu * static_cast<double>(sliding) * dt).epsilon(1e-4));
    stepper.advance(sliding);
    const auto& end = stepper.synchronised();
    CHECK(end.velocity[0][0] == Approx(5.0 / 7 * v_0).epsilon(1e-4));
    const double spin = row(end.spin, 0).norm();
    CHECK(spin * simulator::grain_radius == Approx(end.velocity[0][0]).epsilon(1e-4));
  }
}

}  // namespace shakebed::tests
