#include "fitting/networks/nearest_foreign.hpp"

#include <algorithm>
#include <limits>

namespace shakebed::fitting::networks {

namespace {
constexpr Index mixed = std::numeric_limits<Index>::max();
}

TakenPairs::TakenPairs(std::size_t points, std::span<const WeightedPair> pairs)
    : begin_(points + 1, 0), neighbour_(2 * pairs.size()) {
  for (const auto& pair : pairs) {
    ++begin_[pair.i + 1];
    ++begin_[pair.j + 1];
  }
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (const auto& pair : pairs) {
    neighbour_[next[pair.i]++] = pair.j;
    neighbour_[next[pair.j]++] = pair.i;
  }
  for (std::size_t k = 0; k + 1 < begin_.size(); ++k) {
    std::sort(neighbour_.begin() + begin_[k], neighbour_.begin() + begin_[k + 1]);
  }
}

bool TakenPairs::holds(Index i, Index j) const {
  return std::binary_search(neighbour_.begin() + begin_[i], neighbour_.begin() + begin_[i + 1], j);
}

void NearestForeign::set_components(std::span<const Index> component_of_point) {
  component_ = component_of_point;
  slot_label_.resize(component_.size());
  for (std::size_t slot = 0; slot < component_.size(); ++slot) {
    slot_label_[slot] = component_[tree_.order()[slot]];
  }
  const auto& nodes = tree_.nodes();
  for (std::size_t n = nodes.size(); n-- > 0;) {  // children come after their parents
    const auto& node = nodes[n];
    if (node.leaf()) {
      const Index first = slot_label_[node.begin];
      const bool same =
          std::all_of(slot_label_.begin() + node.begin, slot_label_.begin() + node.end,
                      [&](Index label) { return label == first; });
      node_label_[n] = same ? first : mixed;
    } else {
      const Index left = node_label_[node.left];
      node_label_[n] = left == node_label_[node.right] ? left : mixed;
    }
  }
}

struct NearestForeign::Query {
  Index point;
  Index component;
  const Point& position;
  const TakenPairs& taken;
  WeightedPair& best;
  bool improved = false;
};

bool NearestForeign::improve(Index point, const Point& position, const TakenPairs& taken,
                             WeightedPair& best) const {
  Query query{point, component_[point], position, taken, best};
  descend(0, 0, query);
  return query.improved;
}

void NearestForeign::descend(Index n, double distance, Query& query) const {
  // A branch at exactly the best distance may hold the pair that wins the tie.
  if (distance > query.best.squared_weight || node_label_[n] == query.component) return;
  const auto& node = tree_.nodes()[n];
  if (node.leaf()) {
    look_into(node, query);
    return;
  }
  const double left = near(tree_.nodes()[node.left], query.position);
  const double right = near(tree_.nodes()[node.right], query.position);
  if (left <= right) {
    descend(node.left, left, query);
    descend(node.right, right, query);
  } else {
    descend(node.right, right, query);
    descend(node.left, left, query);
  }
}

void NearestForeign::look_into(const BoxTree::Node& leaf, Query& query) const {
  for (Index slot = leaf.begin; slot < leaf.end; ++slot) {
    if (slot_label_[slot] == query.component) continue;
    const double squared = squared_distance(query.position, tree_.point(slot));
    if (squared > query.best.squared_weight) continue;
    const Index other = tree_.order()[slot];
    const WeightedPair pair{squared, std::min(query.point, other), std::max(query.point, other)};
    if (pair < query.best && !query.taken.holds(query.point, other)) {
      query.best = pair;
      query.improved = true;
    }
  }
}

}  // namespace shakebed::fitting::networks
