#include "fitting/networks/force_histogram.hpp"

#include <algorithm>
#include <cmath>

#include "files/error.hpp"

namespace shakebed::fitting::networks {

double ForceHistogram::density(std::size_t bin) const {
  return static_cast<double>(counts[bin]) / (static_cast<double>(total) * width(bin));
}

double ForceHistogram::density_error(std::size_t bin) const {
  return std::sqrt(static_cast<double>(counts[bin])) / (static_cast<double>(total) * width(bin));
}

namespace {

/// Joins bins from the largest force down; what is left over at 0 goes to its neighbour.
ForceHistogram joined(const std::vector<std::size_t>& fine, double width) {
  ForceHistogram histogram;
  std::vector<double> edges{width * static_cast<double>(fine.size())};
  std::size_t count = 0;
  for (std::size_t bin = fine.size(); bin-- > 0;) {
    count += fine[bin];
    histogram.total += fine[bin];
    if (count < least_count && bin > 0) continue;
    if (count < least_count && !histogram.counts.empty()) {
      histogram.counts.back() += count;
      edges.back() = 0;
      break;
    }
    histogram.counts.push_back(count);
    edges.push_back(width * static_cast<double>(bin));
    count = 0;
  }
  std::reverse(histogram.counts.begin(), histogram.counts.end());
  histogram.edges.assign(edges.rbegin(), edges.rend());
  return histogram;
}

}  // namespace

ForceHistogram force_histogram(std::span<const double> f, double bin_width) {
  if (!std::isfinite(bin_width) || bin_width <= 0) {
    throw files::bad_input("force bin width", "expected a number > 0 (in units of the mean force)");
  }
  double largest = -1;
  for (const double one : f) largest = std::max(largest, one);
  if (largest < 0) return {};
  // One wild force must not ask for a bin per rounding error of it.
  constexpr double most_bins = 1e6;
  const double width = std::max(bin_width, largest / most_bins);
  std::vector<std::size_t> fine(static_cast<std::size_t>(largest / width) + 1, 0);
  for (const double one : f) {
    if (one >= 0) ++fine[static_cast<std::size_t>(one / width)];
  }
  return joined(fine, width);
}

}  // namespace shakebed::fitting::networks
