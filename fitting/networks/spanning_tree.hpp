#pragma once

#include <span>
#include <vector>

#include "fitting/networks/snapshot.hpp"

namespace shakebed::fitting::networks {

/// An edge of a spanning tree, i < j, with its plain (never elongated) length.
struct TreeEdge {
  Index i;
  Index j;
  double length;
  bool operator==(const TreeEdge&) const = default;
};
using SpanningTree = std::vector<TreeEdge>;  ///< by (i, j); one edge fewer than points

/// The multi-pass Euclidean minimum spanning trees of Sun et al., PRE 74, 061307 (2006), Sec.
/// III C: tree p minimises the sum over its edges of
///     w(i, j) = |x_i - x_j| * (elongation if (i, j) is in any of the trees 1 .. p-1, else 1),
/// among all spanning trees of the complete graph. The elongation is flat: an edge taken twice
/// before is not elongated twice. Equal weights are told apart by (i, j), so that each tree is
/// unique; weights are compared as squares.
///
/// Exact on all pairs, and near-linear in time and memory. Boruvka: an edge that is the lightest
/// of all that leave some component belongs to the tree (cut property), so in every round each
/// component but the largest takes its lightest leaving edge. That edge is the lighter of
///  - the nearest pair (grain inside, grain outside) not taken before, by a search of a k-d tree
///    among *all* grains, which passes over a branch only when it lies in the same component or
///    when its box is farther than an edge already in hand; and
///  - the lightest leaving edge among those taken before, which are listed: (p-1)(n-1) at most.
/// No neighbour number or cutoff enters, and a grain 30 d above the bed costs one search, because
/// the largest component never asks for its own way out.
///
/// Throws files::Error(bad_input) for passes < 1 or an elongation that is not finite or below 1.
std::vector<SpanningTree> spanning_trees(std::span<const Point> points, int passes,
                                         double elongation);

}  // namespace shakebed::fitting::networks
