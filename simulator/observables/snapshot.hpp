#pragma once

#include <string>

#include "simulator/boundary/base.hpp"
#include "simulator/grains/grains.hpp"
#include "simulator/motion/neighbours.hpp"
#include "simulator/record.hpp"

namespace shakebed::simulator {

/// "T10.05" for 10.05 cycles as asked for: six decimals, without trailing zeros. (A snapshot is
/// taken at the nearest time step; its `cycles` says where that is.)
std::string snapshot_name(double cycles);

/// (x, z) or (x, y, z) of one grain as x, y, z.
template <int D>
Snapshot::Triple triple(const Columns<D>& columns, std::size_t i) {
  if constexpr (D == 2) return {columns[0][i], 0, columns[1][i]};
  return {columns[0][i], columns[1][i], columns[D - 1][i]};
}

/// Positions wrapped into the periodic cell, velocities and spins.
template <class Physics>
void write_grains(Snapshot& snapshot, const Physics& physics,
                  const typename Physics::GrainState& grains) {
  constexpr int D = Physics::dimension;
  for (int c = 0; c < Dimension<D>::lateral; ++c) {
    if (physics.periodic(c)) snapshot.period[c] = physics.cell.width[c];
  }
  for (std::size_t i = 0; i < grains.count(); ++i) {
    auto position = triple<D>(grains.position, i);
    for (int c = 0; c < Dimension<D>::lateral; ++c) {
      if (physics.periodic(c)) position[c] = physics.cell.wrapped(c, position[c]);
    }
    snapshot.radius.push_back(grain_radius);
    snapshot.position.push_back(position);
    snapshot.velocity.push_back(triple<D>(grains.velocity, i));
    if constexpr (Physics::turns_grains && D == 2)
      snapshot.spin.push_back({0, grains.spin[0][i], 0});
    if constexpr (Physics::turns_grains && D == 3)
      snapshot.spin.push_back(triple<D>(grains.spin, i));
  }
}

/// The normal forces between overlapping grains, F_n of the contact law with the closing speed of
/// this instant, by (i, j).
template <class Physics>
void write_pair_contacts(Snapshot& snapshot, const Physics& physics,
                         const typename Physics::GrainState& grains) {
  constexpr int D = Physics::dimension;
  std::vector<NeighbourPair<D>> pairs;
  NeighbourSearch<D>(physics.cell).find(grains.position, 2 * grain_radius, pairs);
  for (auto [i, j, shift] : pairs) {
    Vector<D> r = row(grains.position, j) - row(grains.position, i);
    for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += shift[c];
    const double distance = r.norm();
    const double overlap = 2 * grain_radius - distance;
    if (overlap <= 0) continue;
    const double closing_speed =
        (row(grains.velocity, i) - row(grains.velocity, j)).dot(r) / distance;
    snapshot.contacts.push_back(
        {std::min(i, j), std::max(i, j), physics.grain_grain.normal.force(overlap, closing_speed)});
  }
  std::sort(snapshot.contacts.begin(), snapshot.contacts.end(),
            [](const SnapshotContact& a, const SnapshotContact& b) {
              return a.i != b.i ? a.i < b.i : a.j < b.j;
            });
}

template <class Physics>
void write_base_contacts(Snapshot& snapshot, const Physics& physics,
                         const typename Physics::GrainState& grains, const BaseState& base) {
  constexpr int vertical = Dimension<Physics::dimension>::vertical;
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const double overlap = base.height + grain_radius - grains.position[vertical][i];
    if (overlap <= 0) continue;
    const double closing_speed = base.velocity - grains.velocity[vertical][i];
    snapshot.contacts.push_back({static_cast<std::int64_t>(i), SnapshotContact::wall,
                                 physics.grain_base.normal.force(overlap, closing_speed)});
  }
}

template <class Physics>
void write_wall_contacts(Snapshot& snapshot, const Physics& physics,
                         const typename Physics::GrainState& grains, const BaseState& base) {
  for (const auto& wall : physics.walls) {
    for (std::size_t i = 0; i < grains.count(); ++i) {
      const double overlap = physics.overlap(wall, grains.position[wall.axis][i], base);
      if (overlap <= 0) continue;
      const bool pushed = wall.moves && wall.axis == wall.drive_axis;
      const double wall_velocity = pushed ? base.velocity : 0;
      const double closing_speed = wall.inward * (wall_velocity - grains.velocity[wall.axis][i]);
      snapshot.contacts.push_back({static_cast<std::int64_t>(i), SnapshotContact::wall,
                                   wall.law.normal.force(overlap, closing_speed)});
    }
  }
}

/// The bed at one step of a cycle. `cycle` counts whole cycles since the base began to move.
/// For laws without memory: every force follows from positions and velocities.
template <class Physics>
Snapshot snapshot_of(const Physics& physics, const typename Physics::GrainState& grains,
                     long step_in_cycle, long cycle) {
  Snapshot snapshot;
  snapshot.cycles = static_cast<double>(cycle) + static_cast<double>(step_in_cycle) /
                                                     static_cast<double>(physics.steps_per_cycle);
  const BaseState base = physics.base_at_step(step_in_cycle);
  snapshot.base_height = base.height;
  snapshot.base_velocity = base.velocity;
  write_grains(snapshot, physics, grains);
  write_pair_contacts(snapshot, physics, grains);
  if constexpr (Physics::walled) {
    write_wall_contacts(snapshot, physics, grains, base);
  } else {
    write_base_contacts(snapshot, physics, grains, base);
  }
  return snapshot;
}

}  // namespace shakebed::simulator
