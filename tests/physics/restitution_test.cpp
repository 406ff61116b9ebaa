// The linear spring-dashpot contact delta'' + (c_n/m_eff) delta' + (k_n/m_eff) delta = 0, ended at
// delta = 0, has e = exp(-c_n t_c / (2 m_eff)) and t_c = pi/sqrt(k_n/m_eff - (c_n/2 m_eff)^2):
// Bhateja 2016, Eqs. A5 and A9 (with the sign put right); Schwager & Poeschel, Granular Matter 9,
// 465 (2007), Sec. 2. m_eff is 1/2 between grains and 1 at the base.
#include <catch2/catch.hpp>

#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

constexpr int phases = 2000;

struct Means {
  double restitution = 0;
  double duration = 0;  ///< over the closed form's
};

template <int D>
Means mean_impact(const Material& material, Partner partner, double steps) {
  Means means;
  for (int k = 0; k < phases; ++k) {
    const auto impact = collide<Smooth<D>>(material, partner, {(k + 0.5) / phases, steps});
    means.restitution += impact.restitution() / phases;
    means.duration += impact.duration / contact_duration(material, partner) / phases;
  }
  return means;
}

template <int D>
double restitution_error(const Material& material, Partner partner, double steps) {
  return mean_impact<D>(material, partner, steps).restitution - material.restitution;
}

template <int D>
double worst_restitution_error(const Material& material, Partner partner, double steps) {
  double worst = 0;
  for (int k = 0; k < 200; ++k) {
    const auto impact = collide<Smooth<D>>(material, partner, {(k + 0.5) / 200, steps});
    worst = std::max(worst, std::abs(impact.restitution() - material.restitution));
  }
  return worst;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("impact: restitution and duration are those of the closed form", "",
                       ((int D), D), 2, 3) {
  for (const double e : {0.1, 0.5, 0.9, 0.95, 1.0}) {
    for (const Partner partner : {Partner::grain, Partner::base}) {
      INFO("e = " << e << (partner == Partner::grain ? " grain-grain" : " grain-base"));
      const Material material{1e6, e};
      const Means coarse = mean_impact<D>(material, partner, 25);
      const Means fine = mean_impact<D>(material, partner, 50);
      CHECK(fine.restitution == Approx(e).margin(1e-3));
      CHECK(fine.duration == Approx(1).margin(2.5e-3));
      // Extrapolated to dt = 0 the closed form itself must appear.
      CHECK((4 * fine.restitution - coarse.restitution) / 3 == Approx(e).margin(4e-5));
      CHECK((4 * fine.duration - coarse.duration) / 3 == Approx(1).margin(4e-4));
    }
  }
}

TEST_CASE("impact: a rough contact has the same restitution") {
  const Material material{1e6, 0.9, 0.4};
  for (const Partner partner : {Partner::grain, Partner::base}) {
    const double mean = entry_phase_average(phases, [&](double phase) {
      return collide<Rough<3>>(material, partner, {phase, 50}).restitution();
    });
    CHECK(mean == Approx(0.9).margin(5e-4));
  }
}

// Halving dt must quarter the error of the entry-phase average. A single impact is first order:
// the dashpot's force jumps from 0 to c_n v_n at a touch that falls anywhere within a step.
TEST_CASE("impact: the entry-phase average converges with dt squared, a single impact with dt") {
  for (const double e : {0.1, 0.5, 0.9, 0.95}) {
    INFO("e = " << e);
    const Material material{1e6, e};
    const double coarse = restitution_error<3>(material, Partner::grain, 20);
    const double fine = restitution_error<3>(material, Partner::grain, 40);
    CHECK(coarse / fine == Approx(4).margin(0.4));
    const double single_coarse = worst_restitution_error<3>(material, Partner::grain, 20);
    const double single_fine = worst_restitution_error<3>(material, Partner::grain, 40);
    CHECK(single_coarse / single_fine == Approx(2).margin(0.25));
  }
}

}  // namespace shakebed::tests
