#include "fitting/least_squares.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "files/error.hpp"
#include "fitting/variable_projection.hpp"
#include "tests/fitting/table3.hpp"

using namespace shakebed::fitting;
using shakebed::files::Error;

namespace {

std::string refusal(const Model& model, const Observations& data, Scale scale = Scale::estimated) {
  try {
    fit_least_squares(model, data, scale);
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::bad_input);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("exact curves of Table III give their parameters back", "[least_squares]") {
  for (const auto& row : table3()) {
    INFO(row.system << " " << row.model.name);
    const auto data = exact(row.model, W_past_the_peak(), {row.abc.begin(), row.abc.end()});
    const auto fit = fit_least_squares(row.model, data, Scale::estimated);
    for (std::size_t k = 0; k < 3; ++k) CHECK(fit.values[k] == Approx(row.abc[k]).epsilon(1e-6));
    CHECK(fit.chi_squared < 1e-14);
  }
}

TEST_CASE("Eq. 6 and the power law give their exact parameters back", "[least_squares]") {
  std::vector<double> V_p;
  for (double W : W_past_the_peak()) V_p.push_back(std::sqrt(W));
  const std::vector<double> equation6{0.141, 0.292, 0.688};
  for (const auto& model : {Model::of<TwoPower>(), Model::of<TwoPowerScaled>()}) {
    const auto fit = fit_least_squares(model, exact(model, V_p, equation6), Scale::estimated);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(fit.values[k] == Approx(equation6[k]).epsilon(1e-6));
    }
  }
  const auto data = exact(Model::of<PowerLaw>(), V_p, {0.3, 1.49});
  for (const auto& fit : {fit_least_squares(Model::of<PowerLaw>(), data, Scale::estimated),
                          fit_log_log(data, Scale::estimated)}) {
    CHECK(fit.values[0] == Approx(0.3).epsilon(1e-8));
    CHECK(fit.values[1] == Approx(1.49).epsilon(1e-8));
  }
}

TEST_CASE("the covariance is the inverse of the normal matrix", "[least_squares]") {
  const auto random = random_stream(11);
  const auto row = table3()[0];
  const auto data = noisy(row.model, W_past_the_peak(), row.abc, 0.01, random.get());
  const auto fit = fit_least_squares(row.model, data, Scale::given);
  // J^T W J summed here by hand; its product with the covariance must be the identity
  double normal[3][3] = {};
  std::vector<double> slope(3);
  for (std::size_t i = 0; i < data.size(); ++i) {
    row.model.gradient(data.x[i], fit.values, slope);
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) normal[j][k] += data.weights[i] * slope[j] * slope[k];
    }
  }
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t k = 0; k < 3; ++k) {
      double product = 0;
      for (std::size_t l = 0; l < 3; ++l) product += normal[j][l] * fit.covariance(l, k);
      CHECK(product == Approx(j == k ? 1.0 : 0.0).margin(1e-6));
    }
  }
  // a and b are told apart by the curve's tail only (correlation 0.94 to 0.97 over this range)
  CHECK(fit.correlation(0, 1) > 0.9);
  const auto scaled = fit_least_squares(row.model, data, Scale::estimated);
  const double ratio = fit.chi_squared / double(fit.degrees_of_freedom);
  CHECK(scaled.standard_error(1) == Approx(std::sqrt(ratio) * fit.standard_error(1)));
}

TEST_CASE("interval ends are where the profile of chi^2 crosses its threshold", "[least_squares]") {
  const auto random = random_stream(12);
  const auto row = table3()[2];
  const auto data = noisy(row.model, W_past_the_peak(), row.abc, 0.02, random.get());
  const auto fit = fit_least_squares(row.model, data, Scale::given);
  // for the nonlinear parameter the profile is what variable projection gives directly
  for (double end : {fit.intervals[1].lower, fit.intervals[1].upper}) {
    CHECK(project(row.model, data, end).chi_squared - fit.chi_squared ==
          Approx(1.959964 * 1.959964).epsilon(1e-2));
  }
}

TEST_CASE("no start finds a better optimum, and plain descents miss it", "[least_squares]") {
  // 300 starts drawn over four decades around each row of Table III
  const auto random = random_stream(13);
  int converged_wrongly = 0;
  for (const auto& row : table3()) {
    const auto data = noisy(row.model, W_past_the_peak(), row.abc, 0.01, random.get());
    const auto fit = fit_least_squares(row.model, data, Scale::given);
    for (int draw = 0; draw < 300; ++draw) {
      std::vector<double> start;
      for (double value : row.abc) {
        start.push_back(value * std::pow(10, gsl_ran_flat(random.get(), -2, 2)));
      }
      const auto descent = descend(row.model, data, start, {false, false, false});
      CHECK(descent.chi_squared >= fit.chi_squared * (1 - 1e-9));
      if (descent.converged && descent.chi_squared > 1.01 * fit.chi_squared) ++converged_wrongly;
    }
  }
  INFO(converged_wrongly << " of 1200 plain descents ended with status success elsewhere");
  CHECK(converged_wrongly > 0);  // why the optimum is not left to a start value
}

TEST_CASE("data that cannot be fitted are refused with the reason", "[least_squares]") {
  const Model model = Model::of<Algebraic>();
  const double nan = std::nan("");
  CHECK_THAT(refusal(model, {{2, 3, 4}, {3, 2, 1}, {1, 1, 1}}),
             Catch::Contains("3 points for the 3 parameters of algebraic"));
  CHECK_THAT(refusal(model, {{2, 2, 2, 2, 2}, {3, 2, 1, 2, 3}, {1, 1, 1, 1, 1}}),
             Catch::Contains("only 1 different x"));
  CHECK_THAT(refusal(model, {{2, 3, 4, 5}, {3, nan, 1, 1}, {1, 1, 1, 1}}),
             Catch::Contains("point 2 is not a finite number"));
  CHECK_THAT(refusal(model, {{2, 3, 4, 5}, {3, 2, 1, 1}, {1, 1, INFINITY, 1}}),
             Catch::Contains("weight inf at x = 4"));
  CHECK_THAT(refusal(model, {{0, 3, 4, 5}, {3, 2, 1, 1}, {1, 1, 1, 1}}),
             Catch::Contains("needs x > 0"));
  CHECK_THROWS_WITH(fit_log_log({{1, 2, 3, 4}, {1, -2, 3, 4}, {1, 1, 1, 1}}, Scale::estimated),
                    Catch::Contains("a log-log fit needs y > 0, got -2 at x = 2"));
}

TEST_CASE("a shape that is not the model's is an error, not a number", "[least_squares]") {
  // a straight line is the limit b -> 0 of the exponential: the best b is the end of the scan
  const Model model = Model::of<Exponential>();
  Observations line;
  for (double x = 2; x < 40; x += 1) {
    line.x.push_back(x);
    line.y.push_back(5 - 0.1 * x);
    line.weights.push_back(1);
  }
  try {
    fit_least_squares(model, line, Scale::estimated);
    FAIL("a straight line was fitted by an exponential");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::failed);
    CHECK_THAT(error.what(), Catch::Contains("do not have the shape of exponential"));
  }
}

TEST_CASE("an interval the data leave open is infinite", "[least_squares]") {
  // a short, noisy range holds the decay to no constant: a may be anything below the data
  const auto random = random_stream(14);
  const auto row = table3()[0];
  const auto data = noisy(row.model, {2.0, 2.7, 3.6, 4.5, 5.6}, row.abc, 0.03, random.get());
  const auto fit = fit_least_squares(row.model, data, Scale::given);
  CHECK(std::isinf(fit.intervals[0].lower));
}
