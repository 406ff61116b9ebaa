// Elastic, frictionless grains on a still base in gravity are an isolated gas: collisions drive any
// start to Maxwell's distribution with equal temperatures along x, y and z (barometric column).
//
// Closed system: energy and, with periodic sides, lateral momentum (here 0) are fixed. Per degree
// of freedom <v_x^2> = (N - 1)/N T and <v_z^2> = T; a component's fourth moment is
// <v^4> = 3 f/(f + 2) <v^2>^2 with f = 5 N - 2 quadratic degrees of freedom (3 N - 2 velocities; a
// height under gravity counts for two: int dz (E - m g z)^(f/2 - 1) ~ E^(f/2)), and excluded volume
// changes only the last term's small number.
//
// False alarms: six two-sided comparisons at 3.89 standard errors each, Gaussian: 6 x 1e-4 for
// another seed (the seed is fixed: the outcome is not random).
#include <catch2/catch.hpp>

#include "simulator/grains/random_stream.hpp"
#include "simulator/observables/correlation.hpp"
#include "tests/physics/impact.hpp"

namespace shakebed::tests {
namespace {

constexpr double quantile = 3.89;

struct Gas {
  std::size_t count;
  std::vector<std::vector<double>> second;  ///< per coordinate: series of <v^2> over grains
  std::vector<std::vector<double>> fourth;  ///< ... and of <v^4>
  double energy = 0;                        ///< per grain
  double worst_energy_error = 0;            ///< per grain
  double rms_energy_step = 0;               ///< between samples, over sqrt(collisions)
  double collisions_per_grain = 0;
};

/// Starts far from equilibrium: all motion along x, every grain at the same speed.
template <int D>
simulator::Grains<D, false> one_speed_along_x(std::size_t count,
                                              const simulator::PeriodicCell<D>& cell) {
  auto grains = simulator::fill<D, false>(count, cell, 5);
  for (std::size_t i = 0; i < count; ++i) grains.velocity[0][i] = i % 2 == 0 ? 2.5 : -2.5;
  return grains;
}

template <int D>
Gas elastic_gas(double steps_per_contact, long samples) {
  Gas gas{D == 2 ? 16u : 48u, {}, {}};
  gas.second.resize(D);
  gas.fourth.resize(D);
  const Material material{2e4, 1};
  const double dt = contact_duration(material, Partner::grain) / steps_per_contact;
  auto physics = still_world<Smooth<D>>(material, 1, dt);
  for (double& width : physics.cell.width) width = D == 2 ? 8 : 4;
  simulator::UniformStepper<Smooth<D>> stepper(physics,
                                               one_speed_along_x<D>(gas.count, physics.cell));
  const auto n = static_cast<double>(gas.count);
  gas.energy = stepper.energy() / n;
  const auto interval = static_cast<long>(1 / dt);
  stepper.advance(100 * interval);
  stepper.ledger() = {};
  double last = stepper.energy();
  double squares = 0;
  for (long s = 0; s < samples; ++s) {
    stepper.advance(interval);
    const double energy = stepper.energy();
    squares += (energy - last) * (energy - last);
    last = energy;
    const auto& grains = stepper.synchronised();
    for (int c = 0; c < D; ++c) {
      double second = 0;
      double fourth = 0;
      for (const double v : grains.velocity[c]) {
        second += v * v / n;
        fourth += v * v * v * v / n;
      }
      gas.second[c].push_back(second);
      gas.fourth[c].push_back(fourth);
    }
    gas.worst_energy_error = std::max(gas.worst_energy_error, std::abs(energy / n - gas.energy));
  }
  gas.rms_energy_step = std::sqrt(squares / static_cast<double>(stepper.ledger().collisions));
  gas.collisions_per_grain = static_cast<double>(stepper.ledger().collisions) / n;
  return gas;
}

/// Mean of the ratio a/b of two series, linearised about their means, and its standard error.
simulator::Estimate ratio(const std::vector<double>& a, const std::vector<double>& b,
                          double power) {
  const double A = simulator::mean_of_series(a).estimate.mean;
  const double B = simulator::mean_of_series(b).estimate.mean;
  std::vector<double> linear(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    linear[k] = A / std::pow(B, power) * (a[k] / A - power * b[k] / B + power);
  }
  return simulator::mean_of_series(linear).estimate;
}

void check_equal(const simulator::Estimate& estimate, double expected, double precision) {
  INFO(estimate.mean << " +- " << estimate.standard_error << ", expected " << expected);
  CHECK(estimate.standard_error < precision);
  CHECK(std::abs(estimate.mean - expected) < quantile * estimate.standard_error);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("elastic gas: Maxwell's distribution and equipartition", "", ((int D), D), 2,
                       3) {
  const Gas gas = elastic_gas<D>(25, D == 2 ? 16000 : 4000);
  const auto n = static_cast<double>(gas.count);
  REQUIRE(gas.collisions_per_grain > 1000);
  // Every collision changes the energy by O(dt^2), up or down with its entry phase: a random walk.
  CHECK(gas.worst_energy_error < 3e-2 * gas.energy);

  constexpr int z = D - 1;
  for (int c = 0; c < z; ++c) {
    INFO("<v_"
         << "xyz"[c] << "^2>/<v_z^2>");
    check_equal(ratio(gas.second[c], gas.second[z], 1), (n - 1) / n, 0.01);
  }
  const double f = (D == 2 ? 4 * n - 1 : 5 * n - 2);
  for (int c = 0; c < D; ++c) {
    INFO("kurtosis, coordinate " << c);
    // A lateral component obeys one more constraint, sum v = 0: with it the fourth moment of one of
    // n numbers on a sphere in n - 1 dimensions, which is the same 3 f/(f + 2).
    check_equal(ratio(gas.fourth[c], gas.second[c], 2), 3 * f / (f + 2), 0.02);
  }
}

// The root mean square of a collision's energy error, from 200 intervals of some 20 collisions:
// known to 5-10 %, so that the ratio 4 of an O(dt^2) error is told from the 2 of an O(dt) one.
TEST_CASE("elastic gas: a collision's energy error shrinks with dt squared") {
  const Gas coarse = elastic_gas<3>(25, 200);
  const Gas fine = elastic_gas<3>(50, 200);
  CHECK(coarse.worst_energy_error < 5e-3 * coarse.energy);
  CHECK(coarse.rms_energy_step / fine.rms_energy_step == Approx(4).margin(1.2));
}

}  // namespace shakebed::tests
