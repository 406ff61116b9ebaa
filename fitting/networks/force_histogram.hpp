#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace shakebed::fitting::networks {

/// Counts of scaled forces f >= 0. Bins have the asked width from 0 on; towards the largest force
/// they are joined until each holds at least `least_count`, so that counting errors mean something.
/// For fits the last bin reaches to infinity.
struct ForceHistogram {
  std::vector<double> edges;  ///< one more than bins; the last is that of the largest force's bin
  std::vector<std::size_t> counts;
  std::size_t total = 0;

  std::size_t bins() const { return counts.size(); }
  double width(std::size_t bin) const { return edges[bin + 1] - edges[bin]; }
  /// P of the bin, normalised over f >= 0, and its counting error sqrt(n).
  double density(std::size_t bin) const;
  double density_error(std::size_t bin) const;
};

inline constexpr std::size_t least_count = 10;

/// `f` may hold negative values: they are left out, as P(f) lives on f >= 0.
/// Throws files::Error(bad_input) for a width that is not a positive number.
ForceHistogram force_histogram(std::span<const double> f, double bin_width);

}  // namespace shakebed::fitting::networks
