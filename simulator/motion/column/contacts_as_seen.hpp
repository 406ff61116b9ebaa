#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "simulator/motion/column/blocks.hpp"
#include "simulator/motion/column/contacts_of.hpp"
#include "simulator/motion/column/physics.hpp"

namespace shakebed::simulator {

inline SeenGrain seen_grain(const RowStore& rows, std::uint32_t row) {
  const MotionRow& motion = rows.motion[row];
  const auto triple = [](const Four& f) { return Triple<double>{f[0], f[1], f[2]}; };
  return {triple(rows.position[row]), triple(motion.velocity), triple(motion.rim_velocity),
          rows.radius[row], rows.mass[row]};
}

inline std::int32_t grain_of(const RowStore& rows, std::uint32_t row) {
  return static_cast<std::int32_t>(rows.grain[row]);
}

/// A spring as a law takes it, nothing where the law has no memory.
template <class Memory>
Memory as_memory(const Triple<double>& u) {
  if constexpr (std::is_empty_v<Memory>) {
    return {};
  } else {
    return u;
  }
}

template <class Physics, class List, class StateOf>
void add_contacts_with_wall(std::vector<ColumnContact>& found, const Physics& physics,
                            const RowStore& rows, const List& list, std::int32_t partner,
                            StateOf state_of) {
  using Memory = typename Physics::template WallMemory<double>;
  for (std::size_t k = 0; k < list.size; ++k) {
    const auto state = state_of(seen_grain(rows, list.row[k]));
    if (state.overlap <= 0) continue;
    found.push_back(contact_now(physics.grain_wall, grain_of(rows, list.row[k]), partner, state,
                                as_memory<Memory>(list.memory_at(k))));
  }
}

/// Contacts with base and side wall at `step`, with forces as they acted.
template <class Physics>
std::vector<ColumnContact> wall_contacts_as_seen(const Physics& physics,
                                                 const ColumnBlocks<Physics>& blocks, long step) {
  std::vector<ColumnContact> found;
  const BaseState base = physics.base_at(step);
  for (const auto& block : blocks.all()) {
    add_contacts_with_wall(found, physics, blocks.rows, block.walls.base.list, base_partner,
                           [&](const SeenGrain& grain) { return base_state(grain, base); });
  }
  for (const auto& block : blocks.all()) {
    add_contacts_with_wall(
        found, physics, blocks.rows, block.walls.side.list, side_partner,
        [&](const SeenGrain& grain) { return side_state(grain, physics.cylinder, base); });
  }
  return found;
}

/// All contacts at `step`, those of pairs first, as seen from the grain of the lower number.
template <class Physics>
std::vector<ColumnContact> contacts_as_seen(const Physics& physics,
                                            const ColumnBlocks<Physics>& blocks, long step) {
  using Memory = typename Physics::template PairMemory<double>;
  const RowStore& rows = blocks.rows;
  std::vector<ColumnContact> found;
  for (const auto& block : blocks.all()) {
    const auto& list = block.touching;
    for (std::size_t k = 0; k < list.size(); ++k) {
      auto i = list.i()[k];
      auto j = list.j()[k];
      auto u = list.memory_at(k);
      if (grain_of(rows, i) > grain_of(rows, j)) {
        std::swap(i, j);
        u = -1.0 * u;  // as seen from the other grain
      }
      found.push_back(contact_now(physics.grain_grain, grain_of(rows, i), grain_of(rows, j),
                                  pair_state(seen_grain(rows, i), seen_grain(rows, j)),
                                  as_memory<Memory>(u)));
    }
  }
  const auto walls = wall_contacts_as_seen(physics, blocks, step);
  found.insert(found.end(), walls.begin(), walls.end());
  return found;
}

}  // namespace shakebed::simulator
