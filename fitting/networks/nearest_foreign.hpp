#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "fitting/networks/box_tree.hpp"

namespace shakebed::fitting::networks {

/// A pair of points with the square of its weight; ordered by weight, then by (i, j).
struct WeightedPair {
  double squared_weight;
  Index i;
  Index j;  ///< i < j
  bool operator<(const WeightedPair& other) const {
    return std::tie(squared_weight, i, j) < std::tie(other.squared_weight, other.i, other.j);
  }
};

/// Pairs that a search must not return, as sorted neighbours of each point.
class TakenPairs {
 public:
  explicit TakenPairs(std::size_t points) : begin_(points + 1, 0) {}
  TakenPairs(std::size_t points, std::span<const WeightedPair> pairs);
  bool holds(Index i, Index j) const;

 private:
  std::vector<Index> begin_;
  std::vector<Index> neighbour_;
};

/// Finds, for one point, the nearest point of another component that is not paired with it yet.
class NearestForeign {
 public:
  explicit NearestForeign(const BoxTree& tree) : tree_(tree), node_label_(tree.nodes().size()) {}

  /// Tells the component of every point; branches that lie in one component are labelled.
  void set_components(std::span<const Index> component_of_point);

  /// Lowers `best` to the least pair (by WeightedPair's order) of `point` with a foreign point, if
  /// any lies below `best`; says whether it did.
  bool improve(Index point, const Point& position, const TakenPairs& taken,
               WeightedPair& best) const;

 private:
  struct Query;
  void descend(Index node, double distance, Query& query) const;
  void look_into(const BoxTree::Node& leaf, Query& query) const;

  const BoxTree& tree_;
  std::vector<Index> node_label_;  ///< component of all its points, or `mixed`
  std::vector<Index> slot_label_;  ///< component of the points in tree order
  std::span<const Index> component_;
};

}  // namespace shakebed::fitting::networks
