#include "fitting/networks/spanning_tree.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "files/csv.hpp"
#include "files/error.hpp"
#include "fitting/networks/nearest_foreign.hpp"

namespace shakebed::fitting::networks {

namespace {

constexpr Index none = std::numeric_limits<Index>::max();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr WeightedPair no_pair{infinity, none, none};

/// Components of the forest grown so far, numbered 0 .. count-1 at every relabelling.
class Forest {
 public:
  explicit Forest(std::size_t points)
      : rank_(points, 0), parent_(points), sets_(rank_.data(), parent_.data()), label_(points) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
    relabel();
  }
  Forest(const Forest&) = delete;
  Forest& operator=(const Forest&) = delete;

  void relabel() {
    std::vector<Index> of_root(label_.size(), none);
    sizes_.clear();
    for (Index point = 0; point < label_.size(); ++point) {
      Index& label = of_root[sets_.find_set(point)];
      if (label == none) {
        label = static_cast<Index>(sizes_.size());
        sizes_.push_back(0);
      }
      label_[point] = label;
      ++sizes_[label];
    }
  }

  bool join(Index i, Index j) {
    const Index one = sets_.find_set(i), other = sets_.find_set(j);
    if (one == other) return false;
    sets_.link(one, other);
    return true;
  }

  Index components() const { return static_cast<Index>(sizes_.size()); }
  Index largest() const {
    return static_cast<Index>(std::max_element(sizes_.begin(), sizes_.end()) - sizes_.begin());
  }
  const std::vector<Index>& labels() const { return label_; }  ///< as of the last relabelling

 private:
  std::vector<Index> rank_;
  std::vector<Index> parent_;
  boost::disjoint_sets<Index*, Index*> sets_;
  std::vector<Index> label_;
  std::vector<Index> sizes_;
};

/// One pass: Boruvka's rounds over the complete graph.
class Pass {
 public:
  Pass(std::span<const Point> points, const BoxTree& tree, std::vector<WeightedPair> elongated)
      : points_(points),
        tree_(tree),
        taken_(points.size(), elongated),
        elongated_(std::move(elongated)),
        forest_(points.size()),
        search_(tree),
        nearest_(points.size(), WeightedPair{0, none, none}) {}

  SpanningTree grow() {
    while (forest_.components() > 1) {
      way_out_.assign(forest_.components(), no_pair);
      search_.set_components(forest_.labels());
      offer_elongated();
      offer_found_before();
      look_for_nearest();
      join();
      forest_.relabel();
    }
    std::sort(edges_.begin(), edges_.end(), [](const TreeEdge& a, const TreeEdge& b) {
      return std::pair(a.i, a.j) < std::pair(b.i, b.j);
    });
    return std::move(edges_);
  }

 private:
  Index label(Index point) const { return forest_.labels()[point]; }
  bool leaves(const WeightedPair& pair) const { return label(pair.i) != label(pair.j); }

  void offer(const WeightedPair& pair) {
    for (const Index end : {pair.i, pair.j}) {
      WeightedPair& best = way_out_[label(end)];
      if (pair < best) best = pair;
    }
  }

  void offer_elongated() {
    std::erase_if(elongated_, [&](const WeightedPair& pair) { return !leaves(pair); });
    for (const auto& pair : elongated_) offer(pair);
  }

  /// A nearest foreign point stays the nearest for as long as it is foreign: components only grow.
  void offer_found_before() {
    for (const auto& pair : nearest_) {
      if (pair.j != none && leaves(pair)) offer(pair);
    }
  }

  /// Searches only where the point might beat what its component has in hand. What was found or
  /// ruled out before is a lower bound, since the foreign points only become fewer.
  void look_for_nearest() {
    const Index largest = forest_.largest();
    for (const Index point : tree_.order()) {
      WeightedPair& known = nearest_[point];
      if (label(point) == largest || (known.j != none && leaves(known))) continue;
      WeightedPair best = way_out_[label(point)];
      if (known.squared_weight > best.squared_weight) continue;
      if (search_.improve(point, points_[point], taken_, best)) {
        known = best;
        offer(best);
      } else {
        known = {best.squared_weight, none, none};
      }
    }
  }

  void join() {
    const Index largest = forest_.largest();
    for (Index component = 0; component < way_out_.size(); ++component) {
      const WeightedPair& pair = way_out_[component];
      if (component == largest || !forest_.join(pair.i, pair.j)) continue;
      edges_.push_back({pair.i, pair.j, distance(points_[pair.i], points_[pair.j])});
    }
  }

  std::span<const Point> points_;
  const BoxTree& tree_;
  TakenPairs taken_;
  std::vector<WeightedPair> elongated_;
  Forest forest_;
  NearestForeign search_;
  std::vector<WeightedPair> nearest_;  ///< of each point; j none: only a bound from below
  std::vector<WeightedPair> way_out_;  ///< lightest edge known to leave each component
  SpanningTree edges_;
};

void check(int passes, double elongation) {
  if (passes < 1) {
    throw files::bad_input("passes", "expected at least 1, got " + std::to_string(passes));
  }
  if (!std::isfinite(elongation) || elongation < 1) {
    throw files::bad_input(
        "elongation", "expected a factor >= 1, got " +
                          (std::isfinite(elongation) ? files::number_text(elongation)
                                                     : std::string("a value that is not finite")));
  }
}

}  // namespace

std::vector<SpanningTree> spanning_trees(std::span<const Point> points, int passes,
                                         double elongation) {
  check(passes, elongation);
  const BoxTree tree(points);
  std::vector<SpanningTree> trees;
  std::vector<WeightedPair> elongated;  // every edge taken so far, once, by (i, j)
  for (int pass = 0; pass < passes; ++pass) {
    trees.push_back(Pass(points, tree, elongated).grow());
    for (const TreeEdge& edge : trees.back()) {
      const double squared = squared_distance(points[edge.i], points[edge.j]);
      elongated.push_back({squared * (elongation * elongation), edge.i, edge.j});
    }
    const auto by_pair = [](const WeightedPair& pair) { return std::pair(pair.i, pair.j); };
    std::ranges::sort(elongated, {}, by_pair);
    const auto repeated = std::ranges::unique(elongated, {}, by_pair);
    elongated.erase(repeated.begin(), repeated.end());
  }
  return trees;
}

}  // namespace shakebed::fitting::networks
