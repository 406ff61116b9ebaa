#include "fitting/networks/contacting_trees.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <numeric>
#include <optional>

namespace shakebed::fitting::networks {

namespace {

Lengths statistics(const std::vector<double>& lengths) {
  Lengths found;
  found.count = lengths.size();
  if (lengths.empty()) return found;
  const auto count = static_cast<double>(lengths.size());
  const auto [shortest, longest] = std::minmax_element(lengths.begin(), lengths.end());
  found.shortest = *shortest;
  found.longest = *longest;
  found.mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / count;
  double squares = 0;
  for (const double one : lengths) squares += (one - found.mean) * (one - found.mean);
  if (lengths.size() > 1) found.standard_deviation = std::sqrt(squares / (count - 1));
  return found;
}

std::optional<Index> contact_of(const Snapshot& snapshot, const TreeEdge& edge) {
  const auto at =
      std::lower_bound(snapshot.contacts.begin(), snapshot.contacts.end(), edge,
                       [](const Contact& contact, const TreeEdge& sought) {
                         return std::pair(contact.i, contact.j) < std::pair(sought.i, sought.j);
                       });
  if (at == snapshot.contacts.end() || at->i != edge.i || at->j != edge.j) return std::nullopt;
  return static_cast<Index>(at - snapshot.contacts.begin());
}

std::vector<int> first_passes(const Snapshot& snapshot, const std::vector<SpanningTree>& trees) {
  std::vector<int> first(snapshot.contacts.size(), 0);
  for (std::size_t pass = 0; pass < trees.size(); ++pass) {
    for (const TreeEdge& edge : trees[pass]) {
      const auto contact = contact_of(snapshot, edge);
      const bool counts = contact && snapshot.contacts[*contact].normal_force != 0;
      if (counts && first[*contact] == 0) first[*contact] = static_cast<int>(pass) + 1;
    }
  }
  return first;
}

PassCounts count(const Snapshot& snapshot, const std::vector<Index>& contacts,
                 std::size_t of_contacts) {
  PassCounts row;
  const auto trees = components(snapshot, contacts);
  if (!trees.empty()) {
    row.NP = trees.front().grains.size();
    row.NE = trees.front().contacts.size();
    row.NT = trees.size() - 1;
    row.NE_rest = contacts.size() - row.NE;
  }
  row.missing = of_contacts - contacts.size();
  std::vector<double> lengths;
  for (const Index k : contacts) lengths.push_back(length(snapshot, snapshot.contacts[k]));
  row.captured = statistics(lengths);
  return row;
}

/// For each missing contact the largest weight on the tree's path between its grains: the weight
/// of the edge that first joins them when the tree's edges are laid in ascending order. Pending
/// contacts of the smaller part are looked at on every join, so each is looked at log n times.
class Detours {
 public:
  Detours(const Snapshot& snapshot, std::vector<MissingContact>& missing)
      : snapshot_(snapshot),
        missing_(missing),
        rank_(snapshot.grains(), 0),
        parent_(snapshot.grains()),
        sets_(rank_.data(), parent_.data()),
        pending_(snapshot.grains()) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
    for (Index m = 0; m < missing.size(); ++m) {
      const Contact& contact = snapshot.contacts[missing[m].contact];
      pending_[contact.i].push_back(m);
      pending_[contact.j].push_back(m);
    }
  }

  void lay(const TreeEdge& edge, double weight) {
    const Index one = sets_.find_set(edge.i), other = sets_.find_set(edge.j);
    sets_.link(one, other);
    const Index root = sets_.find_set(one);
    const Index child = root == one ? other : one;
    if (pending_[child].size() > pending_[root].size()) pending_[child].swap(pending_[root]);
    for (const Index m : pending_[child]) {
      const Contact& contact = snapshot_.contacts[missing_[m].contact];
      if (missing_[m].detour > 0) continue;
      if (sets_.find_set(contact.i) == sets_.find_set(contact.j)) {
        missing_[m].detour = weight;
      } else {
        pending_[root].push_back(m);
      }
    }
    pending_[child] = {};
  }

 private:
  const Snapshot& snapshot_;
  std::vector<MissingContact>& missing_;
  std::vector<Index> rank_;
  std::vector<Index> parent_;
  boost::disjoint_sets<Index*, Index*> sets_;
  std::vector<std::vector<Index>> pending_;
};

void find_detours(const Snapshot& snapshot, const std::vector<SpanningTree>& trees,
                  double elongation, std::vector<MissingContact>& missing) {
  std::vector<std::pair<double, TreeEdge>> weighted;
  const auto by_pair = [](const TreeEdge& a, const TreeEdge& b) {
    return std::pair(a.i, a.j) < std::pair(b.i, b.j);
  };
  for (const TreeEdge& edge : trees.back()) {
    const bool taken = std::any_of(trees.begin(), trees.end() - 1, [&](const SpanningTree& tree) {
      return std::binary_search(tree.begin(), tree.end(), edge, by_pair);
    });
    weighted.emplace_back(taken ? elongation * edge.length : edge.length, edge);
  }
  std::ranges::sort(weighted, {}, [](const auto& one) {
    return std::tuple(one.first, one.second.i, one.second.j);
  });
  Detours detours(snapshot, missing);
  for (const auto& [weight, edge] : weighted) detours.lay(edge, weight);
}

}  // namespace

ContactingTrees contacting_trees(const Snapshot& snapshot, const ForceNetworks& networks,
                                 const std::vector<SpanningTree>& trees, double elongation) {
  ContactingTrees found;
  found.first_pass = first_passes(snapshot, trees);
  for (std::size_t pass = 0; pass < trees.size(); ++pass) {
    std::vector<Index> captured;
    for (const Index k : networks.contacts) {
      const int first = found.first_pass[k];
      if (first > 0 && first <= static_cast<int>(pass) + 1) captured.push_back(k);
    }
    PassCounts row = count(snapshot, captured, networks.contacts.size());
    row.passes = static_cast<int>(pass) + 1;
    std::vector<double> lengths;
    for (const TreeEdge& edge : trees[pass]) lengths.push_back(edge.length);
    row.tree = statistics(lengths);
    found.passes.push_back(row);
  }
  found.network = count(snapshot, networks.contacts, networks.contacts.size());

  const double median = median_diameter(snapshot);
  for (const Index k : networks.contacts) {
    if (found.first_pass[k] != 0) continue;
    const Contact& contact = snapshot.contacts[k];
    found.missing.push_back(
        {k, length(snapshot, contact), 0,
         is_large(snapshot, contact.i, median) || is_large(snapshot, contact.j, median)});
  }
  if (!trees.empty()) find_detours(snapshot, trees, elongation, found.missing);
  return found;
}

}  // namespace shakebed::fitting::networks
