// NIST StRD nonlinear regression (https://www.itl.nist.gov/div898/strd/nls/nls_main.shtml): data,
// certified parameters, standard deviations and residual sums of squares, certified to 11 digits.
#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/least_squares.hpp"
#include "fitting/models/power_law.hpp"

using namespace shakebed::fitting;

namespace {

/// y = b1 (1 - exp(-b2 x)), the form of Misra1a and BoxBOD: separable, with one coefficient.
struct Saturation {
  static constexpr std::string_view name = "saturation";
  static constexpr std::array<std::string_view, 2> parameters{"b1", "b2"};
  static constexpr std::size_t linear_count = 1;
  static constexpr std::size_t nonlinear = 1;
  static constexpr bool positive_x = false;
  static std::array<double, 1> basis(double x, double b2) { return {1 - std::exp(-b2 * x)}; }
  static std::array<double, 2> assemble(double b2, const std::array<double, 1>& b1) {
    return {b1[0], b2};
  }
  static double value(double x, const std::array<double, 2>& b) {
    return b[0] * (1 - std::exp(-b[1] * x));
  }
  static std::array<double, 2> gradient(double x, const std::array<double, 2>& b) {
    return {1 - std::exp(-b[1] * x), b[0] * x * std::exp(-b[1] * x)};
  }
  static SearchInterval search(const std::vector<double>& xs) {
    return {1e-3 / xs.back(), 100 / xs.back(), true};
  }
  static std::array<std::string, 2> units(const std::string& x, const std::string& y) {
    return {y, "1/" + x};
  }
};

struct Certified {
  std::vector<double> values;
  std::vector<double> standard_deviations;
  double residual_sum_of_squares;
};

void check(const Model& model, const std::vector<double>& x, const std::vector<double>& y,
           const Certified& certified) {
  const Observations data{x, y, std::vector<double>(x.size(), 1.0)};
  const auto fit = fit_least_squares(model, data, Scale::estimated);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(fit.values[k] == Approx(certified.values[k]).epsilon(1e-8));
    CHECK(fit.standard_error(k) == Approx(certified.standard_deviations[k]).epsilon(1e-7));
    CHECK(fit.intervals[k].lower < fit.values[k]);
    CHECK(fit.intervals[k].upper > fit.values[k]);
  }
  CHECK(fit.chi_squared == Approx(certified.residual_sum_of_squares).epsilon(1e-9));
  CHECK(fit.degrees_of_freedom == x.size() - 2);
}

}  // namespace

TEST_CASE("NIST DanWood: the power law", "[nist]") {
  check(Model::of<PowerLaw>(), {1.309, 1.471, 1.490, 1.565, 1.611, 1.680},
        {2.138, 3.421, 3.597, 4.340, 4.882, 5.660},
        {{7.6886226176e-01, 3.8604055871e+00},
         {1.8281973860e-02, 5.1726610913e-02},
         4.3173084083e-03});
}

TEST_CASE("NIST Misra1a: slow saturation, lower difficulty", "[nist]") {
  check(Model::of<Saturation>(),
        {77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1,
         760.0},
        {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47,
         81.78},
        {{2.3894212918e+02, 5.5015643181e-04},
         {2.7070075241e+00, 7.2668688436e-06},
         1.2455138894e-01});
}

TEST_CASE("NIST BoxBOD: fast saturation, higher difficulty", "[nist]") {
  check(Model::of<Saturation>(), {1, 2, 3, 5, 7, 10}, {109, 149, 149, 191, 213, 224},
        {{2.1380940889e+02, 5.4723748542e-01},
         {1.2354515176e+01, 1.0455993237e-01},
         1.1680088766e+03});
}
