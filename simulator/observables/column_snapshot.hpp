#pragma once

#include <algorithm>
#include <vector>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/physics.hpp"
#include "simulator/record.hpp"

namespace shakebed::simulator {

/// A bed in a container at one instant, with all that its contacts are. Contacts between grains
/// come first, by (i, j); then those with base and side wall, told apart by their normals.
inline Snapshot column_snapshot(const SizedGrains& grains, std::vector<ColumnContact> contacts,
                                const BaseState& base, bool turns_grains) {
  const auto triple = [](const Columns<3>& columns, std::size_t i) {
    return Snapshot::Triple{columns[0][i], columns[1][i], columns[2][i]};
  };
  Snapshot snapshot;
  snapshot.base_height = base.height;
  snapshot.base_velocity = base.velocity;
  snapshot.radius = grains.radius;
  for (std::size_t i = 0; i < grains.count(); ++i) {
    snapshot.position.push_back(triple(grains.position, i));
    snapshot.velocity.push_back(triple(grains.velocity, i));
    if (turns_grains) snapshot.spin.push_back(triple(grains.spin, i));
  }
  std::sort(contacts.begin(), contacts.end(), [](const ColumnContact& a, const ColumnContact& b) {
    const bool wall_a = a.j < 0;
    const bool wall_b = b.j < 0;
    if (wall_a != wall_b) return wall_b;
    if (wall_a && a.j != b.j) return a.j > b.j;
    return a.i != b.i ? a.i < b.i : a.j < b.j;
  });
  for (const auto& c : contacts) {
    snapshot.contacts.push_back({c.i, c.j < 0 ? SnapshotContact::wall : c.j, c.normal_force});
    snapshot.overlap.push_back(c.overlap);
    snapshot.normal.push_back({c.normal.x, c.normal.y, c.normal.z});
    snapshot.tangential_force.push_back(
        {c.tangential_force.x, c.tangential_force.y, c.tangential_force.z});
  }
  return snapshot;
}

template <class Archive>
void archive_snapshots(Archive& a, std::vector<Snapshot>& snapshots) {
  std::size_t count = snapshots.size();
  a(count);
  snapshots.resize(count);
  for (auto& one : snapshots) {
    std::vector<char> name(one.name.begin(), one.name.end());
    a(name);
    one.name.assign(name.begin(), name.end());
    a(one.cycles);
    a(one.base_height);
    a(one.base_velocity);
    a(one.radius);
    a(one.position);
    a(one.velocity);
    a(one.spin);
    a(one.contacts);
    a(one.overlap);
    a(one.normal);
    a(one.tangential_force);
  }
}

}  // namespace shakebed::simulator
