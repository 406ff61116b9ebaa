#pragma once

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "fitting/networks/spanning_tree.hpp"

// A second way to the same trees: Prim on the dense matrix of weights, with the same total order
// of edges (squared weight, then i, then j), which makes the minimum spanning tree unique.
namespace shakebed::tests {

using fitting::networks::Index;
using fitting::networks::Point;
using fitting::networks::SpanningTree;
using EdgeSet = std::set<std::pair<Index, Index>>;

inline double square(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

class DensePasses {
 public:
  DensePasses(std::vector<Point> points, double elongation)
      : points_(std::move(points)),
        factor_(elongation * elongation),
        taken_(points_.size() * points_.size(), false) {}

  EdgeSet next() {
    using Key = std::tuple<double, Index, Index>;
    const auto n = static_cast<Index>(points_.size());
    std::vector<Key> best(n, Key{std::numeric_limits<double>::infinity(), n, n});
    std::vector<bool> inside(n, false);
    EdgeSet tree;
    Index last = 0;
    for (Index step = 1; step < n; ++step) {
      inside[last] = true;
      Index next = n;
      for (Index k = 0; k < n; ++k) {
        if (inside[k]) continue;
        best[k] = std::min(best[k], Key{weight(last, k), std::min(last, k), std::max(last, k)});
        if (next == n || best[k] < best[next]) next = k;
      }
      tree.emplace(std::get<1>(best[next]), std::get<2>(best[next]));
      last = next;
    }
    for (const auto& [i, j] : tree) taken_[i * points_.size() + j] = true;
    return tree;
  }

  /// Squared weight in the pass to come.
  double weight(Index a, Index b) const {
    const double squared = square(points_[a], points_[b]);
    const bool taken = taken_[std::min(a, b) * points_.size() + std::max(a, b)];
    return taken ? squared * factor_ : squared;
  }

 private:
  std::vector<Point> points_;
  double factor_;
  std::vector<bool> taken_;
};

inline EdgeSet edges(const SpanningTree& tree) {
  EdgeSet set;
  for (const auto& edge : tree) set.emplace(edge.i, edge.j);
  return set;
}

}  // namespace shakebed::tests
