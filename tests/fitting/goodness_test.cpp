#include "fitting/goodness.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/fitting/table3.hpp"

using namespace shakebed::fitting;

TEST_CASE("the runs test's p-value is exact", "[goodness]") {
  // all C(8, 4) = 70 orders of four + and four -, counted by hand of the computer
  int with_at_most[9] = {};
  for (unsigned signs = 0; signs < 256; ++signs) {
    if (__builtin_popcount(signs) != 4) continue;
    int runs = 1;
    for (int i = 1; i < 8; ++i) runs += ((signs >> i) & 1) != ((signs >> (i - 1)) & 1);
    for (int most = runs; most <= 8; ++most) ++with_at_most[most];
  }
  CHECK(with_at_most[8] == 70);
  const std::vector<std::vector<double>> examples{{1, 1, 1, 1, -1, -1, -1, -1},
                                                  {1, 1, 1, -1, -1, -1, -1, 1},
                                                  {1, 1, -1, 1, -1, -1, 1, -1},
                                                  {1, -1, 1, -1, 1, -1, 1, -1}};
  for (const auto& residuals : examples) {
    const auto test = runs_test(residuals);
    CHECK(test.expected_runs == 5);
    CHECK(test.p_value == Approx(with_at_most[test.runs] / 70.0).epsilon(1e-12));
  }
  CHECK(runs_test({1, 1, 1}).p_value == 1);
}

TEST_CASE("the correlation coefficient is sqrt(1 - SS_res/SS_tot) for Table III's forms",
          "[goodness]") {
  const auto random = random_stream(21);
  for (const auto& row : table3()) {
    auto data = noisy(row.model, W_past_the_peak(), row.abc, 0.03, random.get());
    data.weights.assign(data.size(), 1.0);
    const auto fit = fit_least_squares(row.model, data, Scale::estimated);
    double mean = 0, total = 0;
    for (double y : data.y) mean += y / double(data.size());
    for (double y : data.y) total += (y - mean) * (y - mean);
    CHECK(correlation_coefficient(data.y, fit.fitted) ==
          Approx(std::sqrt(1 - fit.chi_squared / total)).epsilon(1e-9));
  }
}

TEST_CASE("AIC prefers the form the data were drawn from", "[goodness]") {
  // 1 % errors over the paper's range separate the two forms by tens of units
  const auto random = random_stream(22);
  const auto rows = table3();
  for (std::size_t truth : {0, 1, 2, 3}) {
    const auto& row = rows[truth];
    const auto data = noisy(row.model, W_past_the_peak(), row.abc, 0.01, random.get());
    double aicc[2];
    for (std::size_t form : {0, 1}) {
      const auto fit = fit_least_squares(rows[form].model, data, Scale::estimated);
      aicc[form] = information_criterion(fit.chi_squared, data.size(), 3, Scale::estimated).aicc;
    }
    CHECK(aicc[truth % 2] + 10 < aicc[1 - truth % 2]);
  }
}

TEST_CASE("AIC counts the parameters and the scale", "[goodness]") {
  // n = 10, chi^2 = 5, p = 3: 10 ln 0.5 + 2 * 4, and 5 + 2 * 3; AICc adds 2k(k+1)/(n-k-1)
  const auto estimated = information_criterion(5, 10, 3, Scale::estimated);
  CHECK(estimated.aic == Approx(10 * std::log(0.5) + 8));
  CHECK(estimated.aicc == Approx(estimated.aic + 2 * 4 * 5 / 5.0));
  const auto given = information_criterion(5, 10, 3, Scale::given);
  CHECK(given.aic == Approx(11));
  CHECK(given.aicc == Approx(11 + 2 * 3 * 4 / 6.0));
}
