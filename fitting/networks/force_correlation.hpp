#pragma once

#include <span>
#include <vector>

#include "fitting/networks/snapshot.hpp"

namespace shakebed::fitting::networks {

/// A contact as F(r) sees it: its place is the midpoint between its grains' centres.
struct PlacedForce {
  Point midpoint;
  double f;       ///< F_n over the mean F_n of the full set of contacts
  int first_set;  ///< it belongs to the sets first_set, first_set + 1, ... (0 is the smallest)
};

/// The force-force correlation of one set of contacts,
///     F(r) = sum_{i<j} delta(r_ij - r) f_i f_j / sum_{i<j} delta(r_ij - r),
/// Eq. 12 of Sun et al., PRE 74, 061307 (2006), with r_ij the distance between the midpoints of
/// contacts i and j, and delta a bin of the given width. It compares forces at the same distance,
/// whatever the directions, and need not tend to 1: a gradient of force along a column puts its
/// plateau above (F of two far contacts is then mean(f)^2 over places, not over contacts).
struct ForceCorrelation {
  double bin_width = 0;  ///< bin k is [k, k+1) bin_width
  std::vector<std::size_t> pairs;
  std::vector<double> F;  ///< NaN where a bin has no pair
  /// One snapshot: the standard deviation that F would have if the same forces were dealt to the
  /// same contacts at random (no correlation): scatter of the null hypothesis, not an error of F.
  std::vector<double> uncorrelated_scatter;
  /// Over replicas: the standard error of the mean of F; empty for one snapshot.
  std::vector<double> standard_error;

  double r(std::size_t bin) const { return (static_cast<double>(bin) + 0.5) * bin_width; }
};

/// F(r) up to r = reach of `sets` nested sets at once, every pair counted once in a k-d tree.
/// Throws files::Error(bad_input) for a width or reach that is not a positive number, or for more
/// than 10,000 bins.
std::vector<ForceCorrelation> force_correlations(std::span<const PlacedForce> contacts, int sets,
                                                 double bin_width, double reach);

/// Mean over independent replicas with the same bins, and the standard error from their spread
/// (NaN for bins seen in fewer than two). `pairs` are summed.
ForceCorrelation mean_over_replicas(std::span<const ForceCorrelation> replicas);

}  // namespace shakebed::fitting::networks
