#include "sweeps/combine.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace shakebed::tests {
namespace {

using simulator::Estimate;
using sweeps::combine;
using sweeps::Combined;
using sweeps::Contribution;

TEST_CASE("One replicate is taken as it is") {
  const Combined one = combine({{{2, 0.1}, 100}});
  CHECK(one.estimate.mean == 2);
  CHECK(one.estimate.standard_error == 0.1);
  CHECK(one.degrees_of_freedom == 0);
}

TEST_CASE("Means are weighted by cycles, and the larger error is kept") {
  // c = 1, 3: x = (1 + 3*2)/4 = 1.75; s_w^2 = (0.4^2 + 9*0.4^2)/16 = 0.1;
  // s_b^2 = (0.75^2 + 3*0.25^2)/(1*4) = 0.1875.
  const Combined scattered = combine({{{1, 0.4}, 1}, {{2, 0.4}, 3}});
  CHECK(scattered.estimate.mean == Approx(1.75));
  CHECK(scattered.estimate.standard_error == Approx(std::sqrt(0.1875)));
  CHECK(scattered.chi_squared == Approx(1.875));
  CHECK(scattered.degrees_of_freedom == 1);
  const Combined agreeing = combine({{{1, 4}, 1}, {{2, 4}, 3}});
  CHECK(agreeing.estimate.standard_error == Approx(std::sqrt(10.0)));
}

TEST_CASE("Beds at rest have neither error nor scatter; unknown errors leave the scatter") {
  const Combined resting = combine({{{0, 0}, 10}, {{0, 0}, 10}});
  CHECK(resting.estimate.mean == 0);
  CHECK(resting.estimate.standard_error == 0);
  CHECK(sweeps::chance_of_scatter(resting) == 1);
  const Combined unknown = combine({{{1, NAN}, 10}, {{3, NAN}, 10}});
  CHECK(unknown.estimate.mean == 2);
  CHECK(unknown.estimate.standard_error == Approx(1));
  CHECK(sweeps::chance_of_scatter(unknown) == 1);
  const Combined without_cycles = combine({{{1, 0.1}, 0}, {{3, 0.1}, 0}});
  CHECK(without_cycles.estimate.mean == 2);
}

TEST_CASE("The chance of a scatter is chi-squared's upper tail") {
  // Tables: the upper 5 % point for 1 dof is 3.841, for 4 dof 9.488.
  CHECK(sweeps::chance_of_scatter({{}, 3.841, 1}) == Approx(0.05).epsilon(1e-3));
  CHECK(sweeps::chance_of_scatter({{}, 9.488, 4}) == Approx(0.05).epsilon(1e-3));
}

struct Synthetic {
  double coverage;  ///< share of trials with |x - truth| < 1.96 standard errors
  double alarms;    ///< share of trials below a 1 % chance of scatter
  double mean_of_x;
};

/// Replicates with true error s/sqrt(c), whose own estimates of it rest on 30 blocks, and a hidden
/// scatter between beds.
Synthetic synthetic(int replicates, double hidden_scatter, int trials) {
  std::mt19937_64 random(20160415);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> chi_squared(29);
  Synthetic result{};
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<Contribution> beds;
    for (int bed = 0; bed < replicates; ++bed) {
      const double cycles = 100 * (1 + bed % 2);
      const double truth = std::hypot(1 / std::sqrt(cycles), hidden_scatter);
      const double own = std::sqrt(chi_squared(random) / 29 / cycles);
      beds.push_back({{5 + truth * normal(random), own}, cycles});
    }
    const Combined combined = combine(beds);
    const double miss = std::abs(combined.estimate.mean - 5);
    result.coverage += (miss < 1.96 * combined.estimate.standard_error) / double(trials);
    result.alarms += (sweeps::chance_of_scatter(combined) < 0.01) / double(trials);
    result.mean_of_x += combined.estimate.mean / trials;
  }
  return result;
}

// 20000 trials with a fixed seed. Binomial standard errors: 0.15 % on a coverage of 95 %, 0.09 % on
// an alarm rate of 1.5 %. Bounds lie at least 4 of them from what is expected, so that a random
// seed would fail one of these checks less than once in 10^4.
TEST_CASE("Combined errors cover, and the scatter test alarms at its stated rate") {
  constexpr int trials = 20000;
  for (const int replicates : {2, 4, 8}) {
    const auto honest = synthetic(replicates, 0, trials);
    INFO(replicates);
    // The larger of two errors covers a little more than 95 %.
    CHECK(honest.coverage > 0.945);
    CHECK(honest.coverage < 0.985);
    CHECK(honest.alarms > 0.006);
    CHECK(honest.alarms < 0.02);
    // s/sqrt(total cycles) = 0.1/sqrt(1.5 R), over sqrt(trials): four of them.
    CHECK(std::abs(honest.mean_of_x - 5) <
          4 * 0.1 / std::sqrt(1.5 * replicates) / std::sqrt(double(trials)));
  }
}

TEST_CASE("Scatter that no bed's own error shows is found and widens the error") {
  constexpr int trials = 4000;
  const double own = 0.1;
  const auto hopping = synthetic(8, 5 * own, trials);
  CHECK(hopping.alarms > 0.99);
  // With 7 degrees of freedom and normal bounds Student's t gives 91 %; own errors alone 25 %.
  CHECK(hopping.coverage > 0.87);
  CHECK(hopping.coverage < 0.95);
}

simulator::Record replicate(double T_z, double error, double cycles) {
  simulator::Record record;
  record.quantities = {{"T_z", "m g d", {T_z, error}}};
  record.scalars = {{"cycles", "1", cycles},
                    {"collisions", "1", 50},
                    {"largest_overlap", "d", T_z / 100},
                    {"k_n", "m g/d", 0.1},
                    {"correlation_time", "cycles", T_z}};
  record.stationary = true;
  return record;
}

double scalar(const sweeps::store::TableRow& row, const std::string& name) {
  for (const auto& value : row.scalars) {
    if (value.name == name) return value.value;
  }
  throw std::out_of_range(name);
}

TEST_CASE("A row sums counts, keeps the largest overlap and averages the rest") {
  const auto row = sweeps::combine_records(
      {replicate(2, 0.5, 100), replicate(2.5, 0.5, 100), replicate(2.25, 0.5, 200)});
  CHECK(row.replicates == 3);
  CHECK(row.cycles == 400);
  CHECK(scalar(row, "collisions") == 150);
  CHECK(scalar(row, "largest_overlap") == 0.025);
  CHECK(scalar(row, "k_n") == 0.1);
  CHECK(scalar(row, "correlation_time") == Approx(2.25));
  CHECK(row.quantities.at(0).estimate.mean == Approx(2.25));
  CHECK(row.stationary_fraction == Approx(1));
  CHECK(row.reason.empty());
}

TEST_CASE("The reason names what a reader of the row must know, once") {
  auto resting = replicate(0, 0, 10);
  resting.at_rest = true;
  resting.warnings = {"soft", "soft"};
  auto moving = replicate(2, 0.01, 10);
  moving.stationary = false;
  moving.stationary_reason = "one plug";
  const auto row = sweeps::combine_records({resting, resting, moving, moving});
  CHECK(row.at_rest_fraction == 0.5);
  CHECK(row.stationary_fraction == 0.5);
  CHECK_THAT(row.reason,
             Catch::StartsWith("at rest; soft; not stationary: one plug; replicates disagree on "
                               "T_z (chi^2 = "));
}

}  // namespace
}  // namespace shakebed::tests
