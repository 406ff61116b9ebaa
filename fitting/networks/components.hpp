#pragma once

#include <span>
#include <utility>
#include <vector>

#include "fitting/networks/snapshot.hpp"

namespace shakebed::fitting::networks {

/// A connected component of a graph whose nodes are grains and whose edges are contacts.
struct Component {
  std::vector<Index> grains;    ///< ascending, at least two
  std::vector<Index> contacts;  ///< indices into Snapshot::contacts, ascending
};

/// Components of the graph of the given contacts, the largest first: by grains, then by contacts,
/// then by the smallest grain. Grains without one of these contacts are in none.
/// Disjoint sets of the Boost Graph Library.
std::vector<Component> components(const Snapshot& snapshot, std::span<const Index> contacts);

/// One force network of a bed.
struct ForceNetwork : Component {
  double coordination = 0;  ///< Z = 2 contacts / grains
  double extent = 0;        ///< largest distance between the centres of two of its grains
  double mean_force = 0;    ///< of F_n over its contacts, pulling ones included

  std::size_t strong_contacts = 0;  ///< contacts with F_n > mean_force
  /// Grains of the largest connected component of the strong contacts (Sun's 3375 reads so) ...
  std::size_t strong_grains = 0;
  /// ... and all grains with at least one strong contact.
  std::size_t grains_with_strong_contact = 0;
};

/// The force networks of a snapshot: connected components of the grain-grain contacts whose normal
/// force is not zero. Contacts with walls belong to no network: two grains that press on the same
/// wall are not joined by it. Source: Sun et al., PRE 74, 061307 (2006), Sec. III B.
struct ForceNetworks {
  std::vector<ForceNetwork> networks;  ///< the largest first, as `components` orders them
  std::vector<Index> contacts;         ///< all that count, over all networks
  double mean_force = 0;               ///< of F_n over these contacts; 0 without contacts
  std::size_t pulling = 0;             ///< of these, contacts with F_n < 0
  std::size_t without_force = 0;       ///< contacts with F_n = 0, left out
};
ForceNetworks force_networks(const Snapshot& snapshot);

/// The contacts of a network with F_n > its mean.
std::vector<Index> strong_contacts(const Snapshot& snapshot, const ForceNetwork& network);

}  // namespace shakebed::fitting::networks
