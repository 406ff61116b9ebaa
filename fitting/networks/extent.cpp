#include "fitting/networks/extent.hpp"

#include <algorithm>
#include <cmath>

#include "fitting/networks/box_tree.hpp"

namespace shakebed::fitting::networks {

namespace {

const Point& farthest_from(const Point& start, std::span<const Point> points) {
  return *std::max_element(points.begin(), points.end(), [&](const Point& a, const Point& b) {
    return squared_distance(start, a) < squared_distance(start, b);
  });
}

class FarthestPair {
 public:
  FarthestPair(const BoxTree& tree, double at_least) : tree_(tree), best_(at_least) {}

  double search() {
    visit(0, 0);
    return best_;
  }

 private:
  double reach(Index a, Index b) const { return far(tree_.nodes()[a], tree_.nodes()[b]); }

  void visit(Index a, Index b) {
    if (reach(a, b) <= best_) return;
    const auto &one = tree_.nodes()[a], &other = tree_.nodes()[b];
    if (one.leaf() && other.leaf()) {
      compare(one, other);
    } else if (a == b) {
      visit(one.left, one.right);
      visit(one.left, one.left);
      visit(one.right, one.right);
    } else if (other.leaf() || (!one.leaf() && one.end - one.begin >= other.end - other.begin)) {
      visit_children(b, one.left, one.right);
    } else {
      visit_children(a, other.left, other.right);
    }
  }

  void visit_children(Index node, Index first, Index second) {
    if (reach(node, second) > reach(node, first)) std::swap(first, second);
    visit(node, first);
    visit(node, second);
  }

  void compare(const BoxTree::Node& one, const BoxTree::Node& other) {
    for (Index i = one.begin; i < one.end; ++i) {
      for (Index j = other.begin; j < other.end; ++j) {
        best_ = std::max(best_, squared_distance(tree_.point(i), tree_.point(j)));
      }
    }
  }

  const BoxTree& tree_;
  double best_;
};

}  // namespace

double extent(std::span<const Point> points) {
  if (points.size() < 2) return 0;
  const Point& end = farthest_from(points.front(), points);
  const double sweep = squared_distance(end, farthest_from(end, points));
  constexpr std::size_t worth_a_tree = 16;
  double best = sweep;
  if (points.size() < worth_a_tree) {
    for (const Point& a : points) {
      for (const Point& b : points) best = std::max(best, squared_distance(a, b));
    }
  } else {
    best = FarthestPair(BoxTree(points), sweep).search();
  }
  return std::sqrt(best);
}

}  // namespace shakebed::fitting::networks
