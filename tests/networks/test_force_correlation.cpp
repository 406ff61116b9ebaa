#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>

#include "files/error.hpp"
#include "fitting/networks/analysis.hpp"
#include "fitting/networks/force_correlation.hpp"
#include "tests/networks/packing.hpp"

using namespace shakebed::tests;
using namespace shakebed::fitting::networks;

namespace {

struct Brute {
  std::vector<double> sum;
  std::vector<std::size_t> pairs;
};
Brute brute(const std::vector<PlacedForce>& contacts, int set, double width, std::size_t bins) {
  Brute found{std::vector<double>(bins, 0.0), std::vector<std::size_t>(bins, 0)};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      if (std::max(contacts[i].first_set, contacts[j].first_set) > set) continue;
      const double r = distance(contacts[i].midpoint, contacts[j].midpoint);
      const auto bin = static_cast<std::size_t>(r / width);
      if (bin >= bins) continue;
      ++found.pairs[bin];
      found.sum[bin] += contacts[i].f * contacts[j].f;
    }
  }
  return found;
}

std::vector<PlacedForce> random_contacts(std::size_t count, Random& random) {
  std::vector<PlacedForce> contacts;
  while (contacts.size() < count) {
    contacts.push_back({{5 * uniform(random), 5 * uniform(random), 12 * uniform(random)},
                        -std::log(uniform(random)),
                        static_cast<int>(3 * uniform(random))});
  }
  return contacts;
}

}  // namespace

TEST_CASE("F(r) of a hand-built chain") {
  // Contacts at x = 0, 1, 2, 3 with f = 2, 1, 0.5, 0.5: F(1) = (2 + 0.5 + 0.25)/3,
  // F(2) = (1 + 0.5)/2, F(3) = 1.
  const std::vector<PlacedForce> chain{
      {{0, 0, 0}, 2, 0}, {{1, 0, 0}, 1, 0}, {{2, 0, 0}, 0.5, 0}, {{3, 0, 0}, 0.5, 0}};
  const auto found = force_correlations(chain, 1, 0.4, 4).front();
  REQUIRE(found.F.size() == 10);
  CHECK(found.pairs == std::vector<std::size_t>{0, 0, 3, 0, 0, 2, 0, 1, 0, 0});
  CHECK(found.F[2] == Approx(2.75 / 3));
  CHECK(found.F[5] == Approx(0.75));
  CHECK(found.F[7] == Approx(1));
  CHECK(std::isnan(found.F[0]));
  CHECK(found.r(2) == Approx(1.0));
}

TEST_CASE("every pair is binned once, in every nested set") {
  Random random(51);
  const auto contacts = random_contacts(1200, random);
  const auto found = force_correlations(contacts, 3, 0.25, 5);
  REQUIRE(found.size() == 3);
  for (int set = 0; set < 3; ++set) {
    const auto& one = found[static_cast<std::size_t>(set)];
    const auto expected = brute(contacts, set, 0.25, 20);
    for (std::size_t bin = 0; bin < 20; ++bin) {
      CHECK(one.pairs[bin] == expected.pairs[bin]);
      CHECK(one.F[bin] ==
            Approx(expected.sum[bin] / static_cast<double>(expected.pairs[bin])).epsilon(1e-11));
    }
  }
}

TEST_CASE("F(r) of uncorrelated forces is flat at 1 within its stated scatter") {
  // Forces of Sun's law dealt at random to the contacts of a bed, 60 times. Dealt without
  // repetition, sum_{i<j} f_i f_j averages to 1 - s^2/(n-1) per pair.
  const auto bed = packing({.small_grains = 1500, .cylinder_diameter = 8}, 52);
  Random random(53);
  auto forces = draw(normalised(0.68, 1.35), bed.contacts.size(), random);
  double mean = 0, variance = 0;
  const auto n = static_cast<double>(forces.size());
  for (const double one : forces) mean += one / n;
  for (double& one : forces) one /= mean;
  for (const double one : forces) variance += (one - 1) * (one - 1) / (n - 1);
  const double expected = 1 - variance / n;

  constexpr int fields = 60;
  std::vector<ForceCorrelation> replicas;
  for (int field = 0; field < fields; ++field) {
    std::shuffle(forces.begin(), forces.end(), random);
    std::vector<PlacedForce> contacts;
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const auto &a = bed.position[bed.contacts[k].i], &b = bed.position[bed.contacts[k].j];
      contacts.push_back({{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2}, forces[k], 0});
    }
    replicas.push_back(force_correlations(contacts, 1, 0.2, 5).front());
  }

  const auto over_all = mean_over_replicas(replicas);
  double squares = 0, ratio = 0;
  int bins = 0;
  for (std::size_t bin = 0; bin < over_all.F.size(); ++bin) {
    if (over_all.pairs[bin] < 100 * fields) continue;
    const double stated = replicas.front().uncorrelated_scatter[bin];
    const double seen = over_all.standard_error[bin] * std::sqrt(fields);
    const double off = (over_all.F[bin] - expected) / (stated / std::sqrt(fields));
    // 24 bins: one of them beyond 4.5 by chance once in 6000.
    CHECK(std::abs(off) < 4.5);
    squares += off * off;
    ratio += seen / stated;
    ++bins;
  }
  REQUIRE(bins > 15);
  std::printf(
      "uncorrelated field: mean squared deviation %.3f over %d bins, spread %.3f of stated\n",
      squares / bins, bins, ratio / bins);
  // Each ratio scatters by 1/sqrt(2 * 59) = 0.09; neighbouring bins are hardly correlated.
  CHECK(ratio / bins == Approx(1).margin(0.1));
  CHECK(squares / bins < 2.2);  // chi-squared of 24 bins over 24: above 2.2 once in 1000
}

TEST_CASE("forces alike among neighbours show as a peak that decays") {
  Random random(54);
  auto contacts = random_contacts(3000, random);
  for (auto& one : contacts) {
    // A wave of length 6 along z: cos correlations, F(r) > 1 near r = 0 and < 1 near r = 3.
    one.f = 1 + 0.8 * std::cos(2 * 3.14159265358979 * one.midpoint[2] / 6);
  }
  const auto found = force_correlations(contacts, 3, 0.25, 4).back();
  CHECK(found.F[0] > 1.2);
  CHECK(found.F[0] > found.F[7]);
  CHECK(found.F[7] > found.F[12]);
}

TEST_CASE("mean and standard error over replicas") {
  ForceCorrelation one, other;
  one.bin_width = other.bin_width = 0.5;
  one.F = {1.0, 2.0, std::nan("")};
  other.F = {3.0, std::nan(""), std::nan("")};
  one.pairs = {10, 5, 0};
  other.pairs = {20, 0, 0};
  const std::vector<ForceCorrelation> both{one, other};
  const auto mean = mean_over_replicas(both);
  CHECK(mean.F[0] == 2.0);
  CHECK(mean.standard_error[0] == Approx(1.0));  // sd sqrt(2), over sqrt(2)
  CHECK(mean.pairs == std::vector<std::size_t>{30, 5, 0});
  CHECK(mean.F[1] == 2.0);
  CHECK(std::isnan(mean.standard_error[1]));
  CHECK(std::isnan(mean.F[2]));
  other.bin_width = 0.25;
  CHECK_THROWS_AS(mean_over_replicas(std::vector<ForceCorrelation>{one, other}),
                  shakebed::files::Error);
  CHECK(spread({1, 2, 3}).mean == 2);
  CHECK(spread({1, 2, 3}).standard_deviation == 1);
  CHECK(std::isnan(spread({4}).standard_deviation));
}

TEST_CASE("bins that make no sense are refused; no contacts give empty bins") {
  const std::vector<PlacedForce> none;
  using shakebed::files::Error;
  CHECK_THROWS_AS(force_correlations(none, 1, 0, 5), Error);
  CHECK_THROWS_AS(force_correlations(none, 1, std::nan(""), 5), Error);
  CHECK_THROWS_AS(force_correlations(none, 1, 0.1, 0.01), Error);
  CHECK_THROWS_AS(force_correlations(none, 1, 1e-9, 5), Error);
  const auto found = force_correlations(none, 2, 0.5, 2);
  REQUIRE(found.size() == 2);
  CHECK(found[1].pairs == std::vector<std::size_t>(4, 0));
}
