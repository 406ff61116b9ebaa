#pragma once

#include <span>

#include "fitting/networks/snapshot.hpp"

namespace shakebed::fitting::networks {

/// The largest distance between two of the points (0 for fewer than two), exact: pairs of k-d
/// tree boxes are left out only when no two of their points can be farther apart than the best
/// pair found so far. That pair starts as the end of a double sweep (the point farthest from the
/// point farthest from the first), which for a column leaves little but its two ends to look at.
double extent(std::span<const Point> points);

}  // namespace shakebed::fitting::networks
