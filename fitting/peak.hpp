#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fitting/least_squares.hpp"

namespace shakebed::fitting {

/// One curve T_z/(m V_p^2) against W, W ascending, with the standard errors of its points.
struct Curve {
  std::vector<double> W;
  std::vector<double> y;
  std::vector<double> error;
};

/// An estimate with its bootstrap standard error and 95 % percentile interval.
struct BootstrapEstimate {
  double value;
  double standard_error;
  Interval interval;
};

/// The fluidisation point W_f: where T_z/(m V_p^2) peaks (Bhateja et al. 2016, Sec. IV).
struct Peak {
  std::size_t highest = 0;  ///< index of the highest measured point
  BootstrapEstimate W_f{};  ///< vertex of the local parabola in ln W
  BootstrapEstimate height{};
  std::size_t points = 0;  ///< on the parabola
  bool refined = false;    ///< false: the grid point itself, bounded by its neighbours
};

struct PeakRule {
  /// The parabola spans the unbroken run of points around the highest whose y is within this share
  /// of it, and at least its two neighbours. Wider is less noisy, narrower is less biased by the
  /// curve's asymmetry.
  double depth = 0.02;
  /// Between grid points the curve's shape is not known: every draw of the bootstrap takes its
  /// parabola in (W^lambda - 1)/lambda with lambda even in [-stretch, stretch], where the estimate
  /// takes ln W (lambda = 0). With 2, curves of the paper's kind on its grid are covered.
  double stretch = 2;
  std::size_t draws = 2000;
  unsigned long seed = 1;
};

/// W_f by a parabola in ln W, weighted by the errors, around the highest point; the bootstrap is
/// parametric (every point redrawn from its normal distribution) and repeats the whole procedure,
/// the choice of the highest point and of lambda included. When the highest point is the first or
/// last of the curve, W_f is that point, not refined, and its interval reaches to the grid points
/// around it
/// (`below`: the next grid point under the curve, at rest or dropped). Throws Error(bad_input)
/// when nothing was measured under the highest point: the sweep begins past its peak.
Peak find_peak(const Curve& curve, std::optional<double> below, const PeakRule& rule = {});

/// Index of the highest point, with the same refusal; looks at no errors.
std::size_t highest_point(const Curve& curve, std::optional<double> below);

/// The end W_2 of the decay: "nearly constant beyond" (Bhateja et al. 2016, Sec. V) read as the
/// first W after which y stays within `within` of the mean of the last `tail` of the points.
struct SettlingRule {
  double within = 0.05;
  double tail = 0.2;
  std::size_t draws = 2000;
  unsigned long seed = 2;
};
struct Settling {
  std::size_t first = 0;  ///< index of the first settled point
  BootstrapEstimate W_2{};
};
Settling find_settling(const Curve& curve, const SettlingRule& rule = {});

/// Index of the first settled point; looks at no errors. Throws Error(failed) when the last point
/// is not within the bound itself.
std::size_t first_settled_point(const Curve& curve, const SettlingRule& rule = {});

}  // namespace shakebed::fitting
