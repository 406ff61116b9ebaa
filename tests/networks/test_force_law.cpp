#include <catch2/catch.hpp>
#include <cmath>

#include "fitting/networks/force_law.hpp"

using namespace shakebed::fitting::networks;

namespace {

/// Simpson's rule, far finer than the tolerance of the comparison.
double quadrature(const auto& function, double from, double to) {
  constexpr int steps = 20000;
  const double h = (to - from) / steps;
  double sum = function(from) + function(to);
  for (int k = 1; k < steps; ++k) sum += (k % 2 == 1 ? 4 : 2) * function(from + k * h);
  return sum * h / 3;
}

}  // namespace

TEST_CASE("closed forms of the force law against quadrature") {
  const ForceLaw law = GENERATE(ForceLaw{2.46, 0.83, 1.35, 0}, ForceLaw{3, 0.75, 1.5, 0},
                                ForceLaw{2.2, 0.9, 1.35, 0.45}, ForceLaw{3.1, 0.8, 1.35, -0.3},
                                ForceLaw{1, -1.5, 0.6, 1.2});
  const auto P = [&](double f) { return law.density(f); };
  CHECK(law.integral(0.3, 0.4) == Approx(quadrature(P, 0.3, 0.4)).epsilon(1e-10));
  CHECK(law.integral(5, 9) == Approx(quadrature(P, 5, 9)).epsilon(1e-10));
  CHECK(law.integral() == Approx(quadrature(P, 0, 60)).epsilon(1e-9));
  const auto fP = [&](double f) { return f * law.density(f); };
  CHECK(law.mean() == Approx(quadrature(fP, 0, 60) / quadrature(P, 0, 60)).epsilon(1e-9));

  for (const auto& [from, to] : {std::pair(0.0, 0.7), std::pair(0.5, 2.0), std::pair(3.0, 50.0)}) {
    const auto moments = gaussian_moments(law.beta, law.theta, from, to);
    const auto moment = [&](int k) {
      return quadrature(
          [&](double f) {
            return std::pow(f, k) * std::exp(-(f - law.theta) * (f - law.theta) - law.beta * f);
          },
          from, to);
    };
    CHECK(moments.M0 == Approx(moment(0)).epsilon(1e-9));
    CHECK(moments.M1 == Approx(moment(1)).epsilon(1e-9));
    CHECK(moments.M2 == Approx(moment(2)).epsilon(1e-9));
  }
}

TEST_CASE("of the printed triples the caption's is the one that is nearly normalised") {
  // a (1/beta - b sqrt(pi)/2 exp(beta^2/4) erfc(beta/2)), worked out apart: 0.8525 and 1.0278.
  const auto published = published_laws();
  CHECK(published[0].law.b == 0.83);
  CHECK(published[0].law.integral() == Approx(0.8525).margin(5e-5));
  CHECK(published[1].law.b == 0.68);
  CHECK(published[1].law.integral() == Approx(1.0278).margin(5e-5));
}

TEST_CASE("normalised laws and the shift of Eq. 13") {
  const auto law = normalised(0.7, 1.3, 0.2);
  CHECK(law.integral() == Approx(1).epsilon(1e-14));
  // a exp(-beta f) = printed_a exp(-beta (f - lambda))
  const double lambda = law.shift_of(2.46);
  CHECK(2.46 * std::exp(1.3 * lambda) == Approx(law.a).epsilon(1e-14));
}
