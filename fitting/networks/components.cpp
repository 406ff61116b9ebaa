#include "fitting/networks/components.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <limits>
#include <numeric>

#include "fitting/networks/extent.hpp"

namespace shakebed::fitting::networks {

namespace {

constexpr Index none = std::numeric_limits<Index>::max();

double mean_force(const Snapshot& snapshot, std::span<const Index> contacts) {
  double sum = 0;
  for (const Index k : contacts) sum += snapshot.contacts[k].normal_force;
  return contacts.empty() ? 0 : sum / static_cast<double>(contacts.size());
}

ForceNetwork force_network(const Snapshot& snapshot, Component component) {
  ForceNetwork network{std::move(component)};
  const auto grains = static_cast<double>(network.grains.size());
  network.coordination = 2 * static_cast<double>(network.contacts.size()) / grains;
  network.mean_force = mean_force(snapshot, network.contacts);
  std::vector<Point> centres;
  for (const Index grain : network.grains) centres.push_back(snapshot.position[grain]);
  network.extent = extent(centres);

  const auto strong = strong_contacts(snapshot, network);
  network.strong_contacts = strong.size();
  const auto parts = components(snapshot, strong);
  for (const Component& part : parts) network.grains_with_strong_contact += part.grains.size();
  if (!parts.empty()) network.strong_grains = parts.front().grains.size();
  return network;
}

}  // namespace

std::vector<Component> components(const Snapshot& snapshot, std::span<const Index> contacts) {
  // Only grains with a contact take part: a bed has thousands of pairs to look at one by one.
  std::vector<Index> grains;
  for (const Index k : contacts) {
    grains.push_back(snapshot.contacts[k].i);
    grains.push_back(snapshot.contacts[k].j);
  }
  std::sort(grains.begin(), grains.end());
  grains.erase(std::unique(grains.begin(), grains.end()), grains.end());
  const auto node = [&](Index grain) {
    return static_cast<Index>(std::lower_bound(grains.begin(), grains.end(), grain) -
                              grains.begin());
  };

  std::vector<Index> rank(grains.size(), 0), parent(grains.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  boost::disjoint_sets<Index*, Index*> sets(rank.data(), parent.data());
  for (const Index k : contacts) {
    sets.union_set(node(snapshot.contacts[k].i), node(snapshot.contacts[k].j));
  }

  std::vector<Component> found;
  std::vector<Index> label(grains.size(), none);
  for (std::size_t n = 0; n < grains.size(); ++n) {
    Index& of_root = label[sets.find_set(static_cast<Index>(n))];
    if (of_root == none) {
      of_root = static_cast<Index>(found.size());
      found.emplace_back();
    }
    found[of_root].grains.push_back(grains[n]);
  }
  for (const Index k : contacts) {
    found[label[sets.find_set(node(snapshot.contacts[k].i))]].contacts.push_back(k);
  }
  // Found in the order of their smallest grains, which a stable sort keeps among equals.
  std::stable_sort(found.begin(), found.end(), [](const Component& a, const Component& b) {
    return std::pair(a.grains.size(), a.contacts.size()) >
           std::pair(b.grains.size(), b.contacts.size());
  });
  return found;
}

std::vector<Index> strong_contacts(const Snapshot& snapshot, const ForceNetwork& network) {
  std::vector<Index> strong;
  for (const Index k : network.contacts) {
    if (snapshot.contacts[k].normal_force > network.mean_force) strong.push_back(k);
  }
  return strong;
}

ForceNetworks force_networks(const Snapshot& snapshot) {
  ForceNetworks all;
  for (std::size_t k = 0; k < snapshot.contacts.size(); ++k) {
    const double force = snapshot.contacts[k].normal_force;
    if (force == 0) {
      ++all.without_force;
      continue;
    }
    if (force < 0) ++all.pulling;
    all.contacts.push_back(static_cast<Index>(k));
  }
  all.mean_force = mean_force(snapshot, all.contacts);
  for (Component& component : components(snapshot, all.contacts)) {
    all.networks.push_back(force_network(snapshot, std::move(component)));
  }
  return all;
}

}  // namespace shakebed::fitting::networks
