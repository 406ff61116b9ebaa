#pragma once

#include <vector>

#include "fitting/networks/components.hpp"
#include "fitting/networks/spanning_tree.hpp"

namespace shakebed::fitting::networks {

/// Lengths of a set of edges [the snapshot's unit of length].
struct Lengths {
  std::size_t count = 0;
  double mean = 0;
  double standard_deviation = 0;
  double shortest = 0;
  double longest = 0;
};

/// A row of Sun's Table II. A tree of contacting particles (TCP) is a connected component of the
/// contacts that the spanning trees of passes 1 .. `passes` hold, each counted once.
struct PassCounts {
  int passes = 0;
  std::size_t NP = 0;       ///< grains of the largest TCP
  std::size_t NE = 0;       ///< its contacts
  std::size_t NT = 0;       ///< number of the other TCPs
  std::size_t NE_rest = 0;  ///< their contacts
  std::size_t missing = 0;  ///< contacts of the force networks that no pass has captured yet
  Lengths tree;             ///< all edges of this pass's tree alone
  Lengths captured;         ///< contacts of passes 1 .. `passes`
};

/// Why a contact is in none of the trees. The last tree joins its grains by a path whose longest
/// edge weighs `detour`, which is less than the contact's own length (or equal, with a tie
/// settled by the order of grains): the contact is the longest edge of a cycle.
struct MissingContact {
  Index contact;
  double length;
  double detour;     ///< largest weight (elongated where taken before) on that path
  bool large_grain;  ///< one of its grains is large: such contacts are longer than their neighbours
};

struct ContactingTrees {
  std::vector<PassCounts> passes;
  PassCounts network;           ///< the same counts of the force networks themselves; passes = 0
  std::vector<int> first_pass;  ///< of every contact of the snapshot; 0: never captured
  std::vector<MissingContact> missing;  ///< after the last pass
};

/// Confronts spanning trees with the force networks. Pass 1 recovers NP and NT of the networks for
/// grains of one size as a rule, not always: grains tied to the rest only through a large grain,
/// whose contacts are long, can be missed.
ContactingTrees contacting_trees(const Snapshot& snapshot, const ForceNetworks& networks,
                                 const std::vector<SpanningTree>& trees, double elongation);

}  // namespace shakebed::fitting::networks
