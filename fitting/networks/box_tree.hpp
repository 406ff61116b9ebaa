#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fitting/networks/snapshot.hpp"

namespace shakebed::fitting::networks {

/// A k-d tree of points whose every node carries the tight bounding box of its points.
///
/// nanoflann builds such trees too, but neither shows a node's box nor lets a search leave out a
/// whole branch by what its points are; the spanning tree needs both (a branch that lies in one
/// component holds no foreign grain) and so does the search for the farthest pair. F(r) uses it
/// too, for its points lie in tree order.
///
/// Bounds hold in floating point, not only on paper: a box side and a coordinate inside it are
/// subtracted, squared and summed in the same order as two coordinates in `squared_distance`, and
/// rounding is monotone, so that near(box, p) <= squared_distance(q, p) <= far(box, p) for every q
/// of the box without any margin.
class BoxTree {
 public:
  struct Node {
    Point low;
    Point high;
    Index begin;  ///< its points are order()[begin .. end)
    Index end;
    Index left = 0;  ///< 0: a leaf. A child comes after its parent.
    Index right = 0;
    bool leaf() const { return left == 0; }
  };

  explicit BoxTree(std::span<const Point> points);

  const std::vector<Node>& nodes() const { return nodes_; }  ///< the root first; empty: no points
  const std::vector<Index>& order() const { return order_; }
  const Point& point(Index slot) const { return points_[slot]; }  ///< of order()[slot]

 private:
  Index build(std::span<const Point> points, Index begin, Index end);

  std::vector<Node> nodes_;
  std::vector<Index> order_;
  std::vector<Point> points_;  ///< in tree order, which is local in memory
};

/// |a - b|^2, the same to the last bit with a and b exchanged.
inline double squared_distance(const Point& a, const Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// The smallest squared distance of `point` from any place in the node's box.
inline double near(const BoxTree::Node& node, const Point& point) {
  double sum[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double below = node.low[axis] - point[axis];
    const double above = point[axis] - node.high[axis];
    const double outside = below > 0 ? below : (above > 0 ? above : 0);
    sum[axis] = outside * outside;
  }
  return sum[0] + sum[1] + sum[2];
}

/// The largest squared distance between a place in one box and a place in the other.
inline double far(const BoxTree::Node& a, const BoxTree::Node& b) {
  double sum[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double one = a.high[axis] - b.low[axis];
    const double other = b.high[axis] - a.low[axis];
    const double most = one > other ? one : other;
    sum[axis] = most * most;
  }
  return sum[0] + sum[1] + sum[2];
}

}  // namespace shakebed::fitting::networks
