#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/list_frame.hpp"
#include "simulator/motion/column/near_walls.hpp"
#include "simulator/motion/column/pair_list.hpp"

namespace shakebed::simulator {

/// The part of a bed that one thread at a time works on: rows [begin, end), the pairs whose lower
/// row is among them, and the walls that they may touch. Upper rows of some pairs belong to the
/// next block: what pulls them stands in the other array of RowStore::pull, which that block takes
/// up later. What blocks write while others work is theirs alone.
template <class Physics>
struct ColumnBlock {
  static constexpr bool pairs_remember =
      !std::is_empty_v<typename Physics::template PairMemory<double>>;

  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::size_t pull = 0;         ///< which array of RowStore::pull it adds to
  std::uint32_t spill_end = 0;  ///< above it no row of the next block is pulled from here

  PairList<pairs_remember> touching;
  PairList<false> candidates;
  NearWalls<Physics> walls;
  std::vector<std::uint32_t> active;  ///< rows that are moved at every step
  ContactCounters counters;
  long touching_walls = 0;

  std::vector<std::uint32_t> broke_promise;  ///< rows, at this step
  MeetingPairs meeting;                      ///< outer pairs of the part, at a window's beginning
  std::vector<std::uint32_t> asked;          ///< outer pairs that broken promises are about
  std::vector<std::uint32_t> found;          ///< of these, those to be listed
  bool outer_too_short = false;              ///< the outer list does not reach as far as promised
  Spread velocity;                           ///< vertical, of its rows
  Spread drift;                              ///< vertical, since the outer list was built
  double farthest = 0;
  std::vector<std::uint32_t> changed;

  /// Row `padding` and the next one touch nothing.
  void take_rows(std::uint32_t first, std::uint32_t past_last, std::uint32_t padding) {
    begin = first;
    end = past_last;
    touching.fill_up_with(padding);
    candidates.fill_up_with(padding);
    walls.take_rows(begin, end, padding);
  }

  /// Rows of the next block that this one pulls lie below `spill_end`.
  void begin_to_touch(std::uint32_t i, std::uint32_t j, double contact_size, double effective_mass,
                      const Triple<double>& u = {0, 0, 0}) {
    touching.push(i, j, contact_size, effective_mass, u);
    note_spill(i, j);
  }
  void note_spill(std::uint32_t i, std::uint32_t j) {
    spill_end = std::max({spill_end, i + 1, j + 1});
  }

  template <class Archive>
  void archive(Archive& a) {
    a(spill_end);
    touching.archive(a);
    candidates.archive(a);
    walls.archive(a);
    a(active);
    a(counters.pair_steps);
    a(counters.wall_steps);
    a(counters.largest_overlap);
    a(touching_walls);
  }
};

}  // namespace shakebed::simulator
