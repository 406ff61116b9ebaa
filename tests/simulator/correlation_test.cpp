// Mean and standard error of correlated series, on x_k = phi x_(k-1) + noise: variance
// 1/(1 - phi^2), integrated correlation time tau = (1 + phi)/(2 (1 - phi)) entries.
#include <catch2/catch.hpp>

#include "simulator/grains/random_stream.hpp"
#include "simulator/observables/correlation.hpp"
#include "simulator/observables/cycle_series.hpp"

namespace shakebed::tests {
namespace {

std::vector<double> autoregressive(double phi, std::size_t length,
                                   simulator::RandomStream& random) {
  std::vector<double> series(length);
  double x = random.normal() / std::sqrt(1 - phi * phi);
  for (double& value : series) {
    value = x;
    x = phi * x + random.normal();
  }
  return series;
}

struct Trial {
  double coverage = 0;  ///< of the true mean by mean +- 1.96 standard errors
  double false_drift = 0;
  double mean_tau = 0;
};

Trial trial(double phi, std::size_t length, int repeats) {
  simulator::RandomStream random(17, simulator::RandomPurpose::thermal_velocities);
  Trial result;
  for (int k = 0; k < repeats; ++k) {
    const auto series = autoregressive(phi, length, random);
    const auto mean = simulator::mean_of_series(series);
    result.coverage += std::abs(mean.estimate.mean) < 1.96 * mean.estimate.standard_error;
    result.mean_tau += mean.correlation_time / repeats;
    result.false_drift += !simulator::halves_agree(series);
  }
  result.coverage /= repeats;
  return result;
}

simulator::CycleSeries two_series() {
  return simulator::CycleSeries({{"a", "1", 1, {}}, {"b", "1", 1, {}}});
}

}  // namespace

// False alarm: binomial scatter of 3000 trials is 0.4 %; bounds of 93 and 96.6 % lie 4 of it from
// 94.6 and 95 %, so below 1e-4 per phi. (tau's own scatter of 5-20 % costs up to 0.4 % coverage.) A
// standard error that ignored correlation would cover 74 % at phi = 0.5 and 35 % at phi = 0.9.
TEST_CASE("mean of a series: 1.96 standard errors cover the mean in 95 % of series") {
  for (const double phi : {0.0, 0.5, 0.9}) {
    const Trial t = trial(phi, 4096, 3000);
    INFO("phi = " << phi << ", coverage " << t.coverage << ", tau " << t.mean_tau);
    CHECK(t.coverage > 0.93);
    CHECK(t.coverage < 0.966);
    CHECK(t.mean_tau == Approx((1 + phi) / (2 * (1 - phi))).epsilon(0.03));
    // 1e-4 each: of 3000 series 0.3 are expected; more than 6 with probability 5e-8 if the
    // standard errors of halves were exact, and they are as good as the coverage says.
    CHECK(t.false_drift <= 6);
  }
}

// Half of the variance jumps, half has tau = 50 entries: the window closes on the jumps. False
// alarm: as above, the trials' scatter is 0.7 % at 1000.
TEST_CASE("mean of a series: cautious errors hold where a slow mode hides behind jumps") {
  simulator::RandomStream random(18, simulator::RandomPurpose::thermal_velocities);
  constexpr double phi = 0.98;
  constexpr int repeats = 1000;
  double plain = 0;
  double cautious = 0;
  for (int k = 0; k < repeats; ++k) {
    auto series = autoregressive(phi, 2048, random);
    for (double& value : series) {
      value = std::sqrt(0.2 * (1 - phi * phi)) * value + random.normal();
    }
    const auto covers = [](const simulator::CorrelatedMean& mean) {
      return std::abs(mean.estimate.mean) < 1.96 * mean.estimate.standard_error;
    };
    plain += covers(simulator::mean_of_series(series));
    cautious += covers(simulator::cautious_mean_of_series(series));
  }
  INFO("coverage: plain " << plain / repeats << ", cautious " << cautious / repeats);
  CHECK(plain / repeats < 0.8);
  CHECK(cautious / repeats > 0.87);
}

TEST_CASE("mean of a series: cautious errors are never smaller, and not much larger") {
  simulator::RandomStream random(19, simulator::RandomPurpose::thermal_velocities);
  double ratio = 0;
  for (int k = 0; k < 200; ++k) {
    const auto series = autoregressive(0.5, 1024, random);
    const auto plain = simulator::mean_of_series(series);
    const auto cautious = simulator::cautious_mean_of_series(series);
    CHECK(cautious.estimate.mean == plain.estimate.mean);
    CHECK(cautious.estimate.standard_error >= plain.estimate.standard_error);
    CHECK(cautious.independent <= plain.independent);
    ratio += cautious.estimate.standard_error / plain.estimate.standard_error / 200;
  }
  CHECK(ratio < 1.25);
}

// Anticorrelation would allow smaller errors; they are not claimed, so the coverage is larger.
TEST_CASE("mean of a series: one that swings is taken as uncorrelated") {
  for (const double phi : {-0.3, -0.9}) {
    const Trial t = trial(phi, 1024, 3000);
    CHECK(t.coverage > 0.966);
    CHECK(t.mean_tau == Approx(0.5).epsilon(0.02));
  }
}

TEST_CASE("mean of a series: a step between its halves is drift") {
  simulator::RandomStream random(4, simulator::RandomPurpose::thermal_velocities);
  auto series = autoregressive(0.5, 2000, random);
  CHECK(simulator::halves_agree(series));
  for (std::size_t k = 1000; k < series.size(); ++k) series[k] += 0.6;  // 6.7 standard errors
  CHECK_FALSE(simulator::halves_agree(series));
}

TEST_CASE("mean of a series: short and constant ones") {
  CHECK(std::isnan(simulator::mean_of_series({}).estimate.mean));
  const std::vector<double> three{1, 2, 6};
  CHECK(simulator::mean_of_series(three).estimate.mean == 3);
  CHECK(std::isnan(simulator::mean_of_series(three).estimate.standard_error));
  const std::vector<double> constant(100, 2.5);
  CHECK(simulator::mean_of_series(constant).estimate.mean == 2.5);
  CHECK(simulator::mean_of_series(constant).estimate.standard_error == 0);
}

TEST_CASE("cycle series: merging keeps means, halves the entries and doubles their cycles") {
  auto series = two_series();
  const long pushed = 3 * simulator::CycleSeries::capacity + 1;
  for (long k = 0; k < pushed; ++k) {
    series.push({static_cast<double>(k), static_cast<double>(k % 2)});
  }
  CHECK(series.cycles() == pushed);
  CHECK(series.cycles_per_entry() == 4);
  CHECK(series[0].cycles_per_entry == 4);
  const std::size_t entries = pushed / 4;
  REQUIRE(series[0].values.size() == entries);
  REQUIRE(series[1].values.size() == entries);
  for (std::size_t e = 0; e < entries; ++e) {
    CHECK(series[0].values[e] == 4.0 * static_cast<double>(e) + 1.5);
    CHECK(series[1].values[e] == 0.5);
  }
}

TEST_CASE("cycle series: memory stays bounded") {
  auto series = two_series();
  for (long k = 0; k < 100000; ++k) series.push({1, 2});
  CHECK(series[0].values.size() < simulator::CycleSeries::capacity);
  CHECK(series[0].values.capacity() <= 2 * simulator::CycleSeries::capacity);
  CHECK(series.cycles() == 100000);
}

}  // namespace shakebed::tests
