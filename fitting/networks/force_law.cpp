#include "fitting/networks/force_law.hpp"

#include <cmath>
#include <numbers>

namespace shakebed::fitting::networks {

namespace {
const double half_sqrt_pi = std::sqrt(std::numbers::pi) / 2;
}  // namespace

GaussianMoments gaussian_moments(double beta, double theta, double from, double to) {
  // (f - theta)^2 + beta f = (f - theta + beta/2)^2 + beta theta - beta^2/4
  const double x0 = from - theta + beta / 2, x1 = to - theta + beta / 2;
  const double scale = half_sqrt_pi * std::exp(beta * beta / 4 - beta * theta);
  // In the tail a difference of erfc keeps the digits that one of erf loses.
  const double M0 = scale * (x0 > 0 ? std::erfc(x0) - std::erfc(x1) : std::erf(x1) - std::erf(x0));

  // M1 and M2 by parts, from the integrals of g' and f g'; g' = -(2 (f - theta) + beta) g.
  const auto g = [&](double f) {
    return std::isinf(f) ? 0 : std::exp(-(f - theta) * (f - theta) - beta * f);
  };
  const double c = beta - 2 * theta;
  const double M1 = (g(from) - g(to) - c * M0) / 2;
  const double to_g = std::isinf(to) ? 0 : to * g(to);
  const double M2 = (M0 + from * g(from) - to_g - c * M1) / 2;
  return {M0, M1, M2};
}

double ForceLaw::density(double f) const {
  return a * (1 - b * std::exp(-(f - theta) * (f - theta))) * std::exp(-beta * f);
}

double ForceLaw::integral(double from, double to) const {
  const double exponential = (std::exp(-beta * from) - std::exp(-beta * to)) / beta;
  return a * (exponential - b * gaussian_moments(beta, theta, from, to).M0);
}

double ForceLaw::integral() const { return integral(0, infinity); }

double ForceLaw::mean() const {
  return a * (1 / (beta * beta) - b * gaussian_moments(beta, theta, 0, infinity).M1) / integral();
}

double ForceLaw::shift_of(double printed_a) const { return std::log(a / printed_a) / beta; }

ForceLaw normalised(double b, double beta, double theta) {
  ForceLaw law{1, b, beta, theta};
  law.a = 1 / law.integral();
  return law;
}

std::vector<PublishedLaw> published_laws() {
  return {{"Sun 2006, text", {2.46, 0.83, 1.35, 0}},
          {"Sun 2006, caption of Fig. 12", {2.46, 0.68, 1.35, 0}},
          {"Mueth 1998", {3.0, 0.75, 1.5, 0}}};
}

PublishedPassLaws published_law_of_pass(int pass) {
  const auto shifted = [](double a, double b, double theta, double lambda) {
    constexpr double beta = 1.35;
    return ForceLaw{a * std::exp(beta * lambda), b, beta, theta};
  };
  switch (pass) {
    case 0:
      return {shifted(2.46, 0.68, 0, 0), shifted(2.46, 0.83, 0, 0)};
    case 1:
      return {shifted(2.2, 0.9, 0.25, 0.5), shifted(2.46, 0.83, 0.45, 0.45)};
    case 2:
      return {shifted(3.1, 0.8, -0.1, -0.1), shifted(2.46, 0.83, 0.1, 0.1)};
    default:
      return {shifted(2.46, 0.83, 0, 0), std::nullopt};
  }
}

}  // namespace shakebed::fitting::networks
