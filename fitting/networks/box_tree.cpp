#include "fitting/networks/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace shakebed::fitting::networks {

namespace {

constexpr Index most_points_in_a_leaf = 8;

void bound(BoxTree::Node& node, std::span<const Point> points, std::span<const Index> members) {
  node.low = node.high = points[members.front()];
  for (const Index member : members) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.low[axis] = std::min(node.low[axis], points[member][axis]);
      node.high[axis] = std::max(node.high[axis], points[member][axis]);
    }
  }
}

std::size_t widest_axis(const BoxTree::Node& node) {
  std::size_t widest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (node.high[axis] - node.low[axis] > node.high[widest] - node.low[widest]) widest = axis;
  }
  return widest;
}

}  // namespace

BoxTree::BoxTree(std::span<const Point> points) : order_(points.size()) {
  std::iota(order_.begin(), order_.end(), Index{0});
  if (points.empty()) return;
  nodes_.reserve(points.size() / 2 + 2);
  build(points, 0, static_cast<Index>(points.size()));
  points_.reserve(points.size());
  for (const Index index : order_) points_.push_back(points[index]);
}

Index BoxTree::build(std::span<const Point> points, Index begin, Index end) {
  const auto here = static_cast<Index>(nodes_.size());
  nodes_.push_back({});
  nodes_[here].begin = begin;
  nodes_[here].end = end;
  bound(nodes_[here], points, std::span(order_).subspan(begin, end - begin));
  if (end - begin <= most_points_in_a_leaf) return here;

  const std::size_t axis = widest_axis(nodes_[here]);
  const Index middle = begin + (end - begin) / 2;
  // The index breaks ties, so that the tree does not depend on the library's nth_element.
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](Index a, Index b) {
        return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
      });
  const Index left = build(points, begin, middle);
  const Index right = build(points, middle, end);
  nodes_[here].left = left;
  nodes_[here].right = right;
  return here;
}

}  // namespace shakebed::fitting::networks
