#pragma once

#include <cmath>
#include <numbers>

namespace shakebed::simulator {

struct SineCosine {
  double sine;
  double cosine;
};

/// sin and cos of 2 pi `cycles`, by Taylor polynomials on an octant (error < 3e-16). Our own,
/// because libm picks variants by CPU, and results must not depend on that.
inline SineCosine sine_cosine_of_cycles(double cycles) {
  const double fraction = cycles - std::floor(cycles);
  const double eighths = std::floor(fraction * 8 + 0.5);
  const double x = 2 * std::numbers::pi * (fraction - eighths / 8);
  const double x2 = x * x;
  const double s =
      x * (1 + x2 * (-1.0 / 6 +
                     x2 * (1.0 / 120 +
                           x2 * (-1.0 / 5040 + x2 * (1.0 / 362880 + x2 * (-1.0 / 39916800 +
                                                                          x2 / 6227020800.0))))));
  const double c =
      1 + x2 * (-0.5 +
                x2 * (1.0 / 24 + x2 * (-1.0 / 720 +
                                       x2 * (1.0 / 40320 +
                                             x2 * (-1.0 / 3628800 +
                                                   x2 * (1.0 / 479001600 - x2 / 87178291200.0))))));
  constexpr double h = std::numbers::sqrt2 / 2;
  switch (static_cast<int>(eighths) & 7) {
    case 0:
      return {s, c};
    case 1:
      return {h * (s + c), h * (c - s)};
    case 2:
      return {c, -s};
    case 3:
      return {h * (c - s), -h * (s + c)};
    case 4:
      return {-s, -c};
    case 5:
      return {-h * (s + c), h * (s - c)};
    case 6:
      return {-c, s};
    default:
      return {h * (s - c), h * (s + c)};
  }
}

/// Height and velocity of the base's surface.
struct BaseState {
  double height;    ///< z_b [d]
  double velocity;  ///< [sqrt(g d)]
};

/// z_b(t) = A sin(omega t), asked by phase in cycles so that time never grows large.
struct BaseMotion {
  double amplitude;      ///< A [d]; 0: still
  double peak_velocity;  ///< A omega [sqrt(g d)]

  BaseState at(double cycles) const {
    const SineCosine s = sine_cosine_of_cycles(cycles);
    return {amplitude * s.sine, peak_velocity * s.cosine};
  }
  /// A omega^2 [g].
  double largest_acceleration() const {
    return amplitude == 0 ? 0 : peak_velocity * peak_velocity / amplitude;
  }
};

}  // namespace shakebed::simulator
