#include <catch2/catch.hpp>
#include <numbers>

#include "simulator/grains/random_stream.hpp"
#include "simulator/observables/height_profile.hpp"
#include "simulator/observables/temperature.hpp"

namespace shakebed::tests {
namespace {

using simulator::Estimate;
using simulator::HeightProfile;
using simulator::RandomStream;

constexpr auto thermal = simulator::RandomPurpose::thermal_velocities;

const simulator::ProfileColumn& column(const simulator::Profile& profile, const std::string& name) {
  for (const auto& one : profile.columns) {
    if (one.name == name) return one;
  }
  FAIL("no column " << name);
  return profile.columns.front();
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

template <int D>
simulator::Grains<D, false> grains_at(const std::vector<double>& heights,
                                      const std::vector<double>& vertical_velocities) {
  simulator::Grains<D, false> grains;
  grains.resize_to(heights.size());
  grains.position[D - 1] = heights;
  grains.velocity[D - 1] = vertical_velocities;
  return grains;
}

/// Width of the unit sphere's or disc's section at height s over its largest: an integrand whose
/// integral over [-1/2, 1/2] is 2/3 or pi/4.
template <int D>
double section(double s) {
  const double square = std::max(0.0, 1 - 4 * s * s);
  return D == 3 ? square : std::sqrt(square);
}

/// A block of `count` grains in the box [0, 1) with random velocities of variance `variance`.
simulator::Grains<2, false> random_block(RandomStream& random, std::size_t count, double variance) {
  simulator::Grains<2, false> grains;
  grains.resize_to(count);
  for (std::size_t i = 0; i < count; ++i) {
    grains.position[1][i] = random.uniform();
    for (auto& velocity : grains.velocity) velocity[i] = std::sqrt(variance) * random.normal();
  }
  return grains;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("profile: the cap formula is the integral over sections", "", ((int D), D),
                       2, 3) {
  constexpr int slices = 200000;
  double integral = 0;
  const double whole = D == 3 ? 2.0 / 3 : std::numbers::pi / 4;
  for (int k = 0; k < slices; ++k) {
    const double s = (k + 0.5) / slices - 0.5;
    integral += section<D>(s) / slices / whole;
    if (k % 10000 == 9999) {
      CHECK(simulator::part_below<D>((k + 1.0) / slices - 0.5) == Approx(integral).margin(1e-7));
    }
  }
  CHECK(simulator::part_below<D>(-0.5) == Approx(0).margin(1e-15));
  CHECK(simulator::part_below<D>(0.5) == Approx(1));
}

// One grain between two boxes: the part above the border by the cap formula, which the profile
// reads off a table in two dimensions.
TEMPLATE_TEST_CASE_SIG("profile: a grain is shared out by the cap formula", "", ((int D), D), 2,
                       3) {
  constexpr double area = 7;
  const double whole = D == 3 ? std::numbers::pi / 6 : std::numbers::pi / 4;
  for (const double above : {-0.4999, -0.37, -0.1, 0.0, 0.0123, 0.25, 0.499}) {
    HeightProfile<D> profile(0, area);
    profile.sample(grains_at<D>({5 + above}, {0}));
    profile.end_cycle();
    const auto summary = profile.summarise();
    const auto& phi = column(summary.profile, "phi").mean;
    const double below = simulator::part_below<D>(-above);
    REQUIRE(phi.size() >= 5);
    CHECK(phi[4] * area / whole == Approx(below).margin(1.01e-5));
    if (phi.size() > 5) CHECK(phi[5] * area / whole == Approx(1 - below).margin(1.01e-5));
  }
}

// Wherever grains are, sum of phi over boxes x (box area x 1 d) is the grains' volume, and the
// boxes hold each centre once.
TEMPLATE_TEST_CASE_SIG("profile: counts sum to the grains, phi to their volume", "", ((int D), D),
                       2, 3) {
  RandomStream random(3, simulator::RandomPurpose::filling);
  const double area = 7;
  HeightProfile<D> profile(-2, area);
  for (int cycle = 0; cycle < 100; ++cycle) {
    std::vector<double> heights;
    for (int i = 0; i < 30; ++i) heights.push_back(-1.5 + 20 * random.uniform());
    heights.push_back(5);  // exactly between two boxes
    profile.sample(grains_at<D>(heights, std::vector<double>(heights.size(), 0.0)));
    profile.end_cycle();
  }
  const auto result = profile.summarise().profile;
  CHECK(sum(column(result, "grains_in_box").mean) == Approx(31).epsilon(1e-12));
  const double size = D == 3 ? std::numbers::pi / 6 : std::numbers::pi / 4;
  CHECK(sum(column(result, "phi").mean) * area == Approx(31 * size).epsilon(1e-12));
  CHECK(result.z.front() == -1.5);
}

// Every state sampled with its mirror image v -> -v leaves no local mean velocity, so that boxes
// hold all of the kinetic energy: sum over boxes of grains x T_c = sum over grains of (m/2) v_c^2.
TEMPLATE_TEST_CASE_SIG("profile: local temperatures sum to the kinetic energy", "", ((int D), D), 2,
                       3) {
  RandomStream random(4, simulator::RandomPurpose::thermal_velocities);
  HeightProfile<D> profile(0, 7);
  double energy = 0;
  for (int cycle = 0; cycle < 100; ++cycle) {
    std::vector<double> heights;
    std::vector<double> velocities;
    for (int i = 0; i < 30; ++i) {
      heights.push_back(12 * random.uniform());
      velocities.push_back((1 + heights.back()) * random.normal());
      energy += 0.5 * velocities.back() * velocities.back() / 100;
    }
    profile.sample(grains_at<D>(heights, velocities));
    for (double& v : velocities) v = -v;
    profile.sample(grains_at<D>(heights, velocities));
    profile.end_cycle();
  }
  const auto result = profile.summarise().profile;
  const auto& grains = column(result, "grains_in_box").mean;
  const auto& T_z = column(result, "T_z").mean;
  double held = 0;
  for (std::size_t k = 0; k < grains.size(); ++k) held += grains[k] * T_z[k];
  CHECK(held == Approx(energy).epsilon(1e-12));
}

// One grain centred 0.2 d above the middle of box [1, 2): 0.2 d of it reach into box [2, 3).
TEST_CASE("profile: a grain's volume is shared between boxes as it lies") {
  HeightProfile<3> profile(0, 1);
  profile.sample(grains_at<3>({1.7}, {0}));
  const auto result = profile.summarise().profile;
  const auto& phi = column(result, "phi").mean;
  const double above = 0.2 * 0.2 * (3 - 2 * 0.2);  // cap of height h: h^2 (3 - 2h) of the volume
  CHECK(phi[2] == Approx(above * std::numbers::pi / 6));
  CHECK(phi[1] == Approx((1 - above) * std::numbers::pi / 6));
  CHECK(phi[0] == 0);
}

// 100 grains in [0, 1) at w = +-1 (T_z = 1/2), 100 in [1, 2) at w = +-3 (T_z = 9/2): 99 % of
// centres lie below 1.98, and T_z_volume = (1 x 1/2 + 0.98 x 9/2)/1.98.
TEST_CASE("profile: the volume average weighs heights, not grains") {
  std::vector<double> heights;
  std::vector<double> velocities;
  for (int i = 0; i < 200; ++i) {
    const bool upper = i >= 100;
    heights.push_back(upper ? 1.5 : 0.5);
    velocities.push_back((i % 2 == 0 ? 1 : -1) * (upper ? 3.0 : 1.0));
  }
  HeightProfile<3> profile(-1, 25);
  profile.sample(grains_at<3>(heights, velocities));
  profile.end_cycle();
  const auto summary = profile.summarise();
  CHECK(summary.averaging_height == Approx(1.98));
  const double expected = (0.5 + 0.98 * 4.5) / 1.98;
  CHECK(summary.volume_temperature[2].mean == Approx(expected));
  CHECK(summary.volume_temperature[0].mean == 0);
  CHECK(summary.volume_temperature[3].mean == Approx(expected / 3));
  CHECK(summary.packing_fraction.mean == Approx(200 * std::numbers::pi / 6 / (25 * 1.98)));
  const auto& T_z = column(summary.profile, "T_z").mean;
  CHECK(T_z[0] == 0);
  CHECK(T_z[1] == Approx(0.5));
  CHECK(T_z[2] == Approx(4.5));
}

// The local mean velocity in time is removed: grains that all pass at w = 2 are not warm.
TEST_CASE("profile: the local temperature is about the local mean velocity") {
  HeightProfile<3> profile(0, 1);
  profile.sample(grains_at<3>({0.5, 0.5, 0.5, 0.5}, {1, 3, 1, 3}));
  const auto result = profile.summarise().profile;
  CHECK(column(result, "T_z").mean[0] == Approx(0.5));
}

// T = m(<v^2> - <<v>_phase^2>)/2: rising at 3 and 5 at one phase, falling at -2 and -4 at another,
// deviations are +-1 throughout. About the mean over time they are not.
TEST_CASE("profile: about the mean at each phase the drive's own motion is not warm") {
  HeightProfile<3> by_phase(0, 1, HeightProfile<3>::LocalMean::phase);
  HeightProfile<3> by_time(0, 1);
  for (auto* profile : {&by_phase, &by_time}) {
    profile->sample(grains_at<3>({0.5}, {3}), {0, 0}, 2);
    profile->sample(grains_at<3>({0.5}, {-2}), {0, 0}, 9);
    profile->end_cycle();
    profile->sample(grains_at<3>({0.5}, {5}), {0, 0}, 2);
    profile->sample(grains_at<3>({0.5}, {-4}), {0, 0}, 9);
    profile->end_cycle();
  }
  CHECK(column(by_phase.summarise().profile, "T_z").mean[0] == Approx(0.5));
  CHECK(column(by_time.summarise().profile, "T_z").mean[0] ==
        Approx(0.5 * ((9 + 4 + 25 + 16) / 4.0 - 0.25)));
}

// Of two instants with speeds (1, 3) and one with a lone grain: variances 1, 1 and none, so
// T = (1 + 1 + 0)/(2 * 3); about the mean over time the same grains have another one.
TEST_CASE("profile: a temperature box by box and instant by instant counts lone grains as cold") {
  HeightProfile<3> profile(0, 1, HeightProfile<3>::LocalMean::instant);
  profile.sample(grains_at<3>({0.5, 0.5}, {1, 3}));
  profile.sample(grains_at<3>({0.5, 0.5}, {-1, 1}));
  profile.sample(grains_at<3>({0.5}, {7}));
  profile.end_cycle();
  const auto result = profile.summarise().profile;
  CHECK(column(result, "T_z").mean[0] == Approx(2.0 / 6));
  CHECK(column(result, "grains_in_box").mean[0] == Approx(5.0 / 3));
}

// Heights and velocities relative to a base that moves: grains riding on it are cold and low.
TEST_CASE("profile: the base's frame moves with the base") {
  HeightProfile<3> profile(0, 1);
  profile.sample(grains_at<3>({1.5, 1.5}, {2, 2}), {1, 2});
  profile.sample(grains_at<3>({-0.5, -0.5}, {-2, -2}), {-1, -2});
  profile.end_cycle();
  const auto result = profile.summarise().profile;
  CHECK(result.z.front() == 0.5);
  CHECK(column(result, "grains_in_box").mean[0] == 2);
  CHECK(column(result, "T_z").mean[0] == 0);
}

// For a plain mean the jackknife is the classical standard error s/sqrt(B).
TEST_CASE("profile: jackknife errors of counts are the classical ones") {
  HeightProfile<3> profile(0, 1);
  const std::vector<int> counts{3, 7, 4, 4, 9, 5, 2, 6};
  double mean = 0;
  double square = 0;
  for (const int count : counts) {
    profile.sample(grains_at<3>(std::vector<double>(count, 0.5), std::vector<double>(count, 0.0)));
    profile.end_cycle();
    mean += count / 8.0;
    square += count * count / 8.0;
  }
  const auto result = profile.summarise().profile;
  CHECK(column(result, "grains_in_box").mean[0] == Approx(mean));
  CHECK(column(result, "grains_in_box").standard_error[0] ==
        Approx(std::sqrt((square - mean * mean) / 7)));
}

// Spread of T over 400 independent profiles against the error each states. The spread of 400
// values is known to 1/sqrt(2 x 400) = 3.5 %, and the mean error is a little noisy: 4 standard
// errors are 15 % (false alarm 1e-4).
TEST_CASE("profile: jackknife errors of temperatures are their spread") {
  RandomStream random(9, thermal);
  constexpr int repeats = 400;
  double mean = 0;
  double square = 0;
  double stated = 0;
  for (int k = 0; k < repeats; ++k) {
    HeightProfile<2> profile(0, 5);
    for (int cycle = 0; cycle < 60; ++cycle) {  // 60 cycles: blocks are merged once
      profile.sample(random_block(random, 5, 1 + 0.5 * random.uniform()));
      profile.end_cycle();
    }
    const auto result = profile.summarise().profile;
    const double T = column(result, "T_z").mean[0];
    mean += T / repeats;
    square += T * T / repeats;
    stated += column(result, "T_z").standard_error[0] / repeats;
  }
  CHECK(mean == Approx(0.5 * 1.25).epsilon(0.02));
  CHECK(stated == Approx(std::sqrt(square - mean * mean)).epsilon(0.15));
}

// Counts of 3 or 7 (standard deviation 2), each held for 8 cycles: 1024 cycles hold 128 independent
// ones, so that the mean is known to 2/sqrt(128). Blocks of one cycle would state 2/sqrt(1024).
// Over 60 profiles, of 16 blocks each, the mean stated error scatters by 2.4 %.
TEST_CASE("profile: blocks grow longer than the correlation time") {
  RandomStream random(6, thermal);
  constexpr int repeats = 60;
  double stated = 0;
  for (int k = 0; k < repeats; ++k) {
    HeightProfile<3> profile(0, 1);
    int count = 0;
    for (int cycle = 0; cycle < 1024; ++cycle) {
      if (cycle % 8 == 0) count = random.uniform() < 0.5 ? 3 : 7;
      profile.sample(grains_at<3>(std::vector<double>(count, 0.5), std::vector<double>(count)));
      profile.end_cycle();
    }
    const auto result = profile.summarise().profile;
    stated += column(result, "grains_in_box").standard_error[0] / repeats;
  }
  CHECK(stated == Approx(2 / std::sqrt(128.0)).epsilon(0.1));
}

TEST_CASE("profile: fewer than four blocks have no error") {
  HeightProfile<3> profile(0, 1);
  for (int cycle = 0; cycle < 3; ++cycle) {
    profile.sample(grains_at<3>({0.5}, {0}));
    profile.end_cycle();
  }
  CHECK(std::isnan(column(profile.summarise().profile, "phi").standard_error[0]));
}

// Bhateja 2016, Eq. 5 with its 1/2: T_c = (m/2) <(v_c - <v_c>)^2>.
TEST_CASE("temperature: half the variance over grains, and half the mean square in the lab") {
  simulator::TemperatureSums<2> sums;
  simulator::Grains<2, false> grains;
  grains.resize_to(4);
  grains.velocity[0] = {1, 2, 3, 4};
  grains.velocity[1] = {5, 5, 5, 5};
  grains.position[1] = {0, 1, 2, 5};
  sums.sample(simulator::moments_of(grains));
  for (auto& v : grains.velocity[0]) v = 0;
  sums.sample(simulator::moments_of(grains));
  const auto averages = sums.take();  // T_x, T_z, T_x_lab, T_z_lab, h_cm
  REQUIRE(averages.size() == 5);
  CHECK(averages[0] == Approx(0.5 * 1.25 / 2));
  CHECK(averages[1] == Approx(0).margin(1e-14));
  CHECK(averages[2] == Approx(0.5 * 7.5 / 2));
  CHECK(averages[3] == Approx(0.5 * 25));
  CHECK(averages[4] == Approx(2));
  sums.sample(simulator::moments_of(grains));
  CHECK(sums.take()[0] == 0);  // taking starts afresh
}

}  // namespace shakebed::tests
