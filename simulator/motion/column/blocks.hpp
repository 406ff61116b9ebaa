#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/motion/column/block.hpp"
#include "simulator/motion/column/outer_list.hpp"
#include "simulator/motion/column/remembered.hpp"
#include "simulator/motion/column/work_division.hpp"

namespace shakebed::simulator {

/// A bed's rows in blocks, each with the contacts that it reckons with. Pairs of rows in blocks
/// apart, and those of large grains, are in one more block without rows, `far`, whose contacts
/// are added before those of the others.
template <class Physics>
class ColumnBlocks {
 public:
  using Block = ColumnBlock<Physics>;

  RowStore rows;
  BlockCuts cuts;
  WorkDivision division;

  ColumnBlocks(const SizedGrains& start, Crew* crew)
      : rows(start, BlockCuts(start.count()).count() + 1),
        cuts(rows.count()),
        division(crew, cuts.count()),
        blocks_(cuts.count() + 1) {
    for (std::size_t p = 0; p < cuts.count(); ++p) {
      blocks_[p].take_rows(cuts.begin(p), cuts.end(p), rows.padding(p));
      blocks_[p].pull = p % 2;
    }
    far().take_rows(0, 0, rows.padding(cuts.count()));
    far().end = std::numeric_limits<std::uint32_t>::max();
    rows.reorder(rows.by_height());
  }

  /// All blocks and, last, `far`.
  const std::vector<Block>& all() const { return blocks_; }
  std::vector<Block>& all() { return blocks_; }
  Block& far() { return blocks_.back(); }
  Block& of_row(std::uint32_t i) { return blocks_[cuts.block_of(i)]; }
  /// The block of a part of the outer list.
  Block& of_part(std::size_t part) { return blocks_[part]; }

  /// work(block, its number) for all but `far`, by the crew.
  template <class Work>
  void share(const Work& work) {
    division.share([&](std::size_t p, bool) { work(blocks_[p], p); });
  }

  /// work(block, its number, whether the block below is done); where it is not, `later` is called
  /// when it is.
  template <class Work, class Later>
  void share_upwards(const Work& work, const Later& later) {
    division.share([&](std::size_t p, bool first) { work(blocks_[p], p, !first); });
    if (division.threads() == 1) return;
    division.share([&](std::size_t p, bool first) {
      if (first) later(blocks_[p], p);
    });
  }

  void divide_work() {
    division.divide(cuts.count(), [&](std::size_t p) {  // in the time that one contact takes
      const Block& block = blocks_[p];
      return block.touching.size() + 2 * block.active.size() + block.candidates.size() / 2;
    });
  }

  ContactCounters counters() const {
    ContactCounters sum;
    for (const Block& block : blocks_) {
      sum.pair_steps += block.counters.pair_steps;
      sum.wall_steps += block.counters.wall_steps;
      sum.largest_overlap = std::max(sum.largest_overlap, block.counters.largest_overlap);
    }
    return sum;
  }

  /// Adds what the block below has put aside for rows of block p.
  void take_up_spill(std::size_t p) {
    if (p == 0) return;
    for (std::uint32_t i = blocks_[p].begin; i < blocks_[p - 1].spill_end; ++i) {
      move_pull(rows.pull[blocks_[p - 1].pull][i], rows.pull[blocks_[p].pull][i]);
    }
  }

  /// What contacts of `far` have added to the first array goes to those of their rows' own blocks.
  /// Before other contacts are added.
  void take_up_far() {
    const auto& list = far().touching;
    for (std::size_t k = 0; k < list.size(); ++k) {
      for (const auto i : {list.i()[k], list.j()[k]}) {
        const std::size_t own = of_row(i).pull;
        if (own != far().pull) move_pull(rows.pull[far().pull][i], rows.pull[own][i]);
      }
    }
  }

  const PullRow& pull_of(std::uint32_t i) const {
    return rows.pull[blocks_[cuts.block_of(i)].pull][i];
  }

  /// Takes up the contacts of a bed as it stands, with what they remember.
  void meet_all(const OuterList& outer, const std::vector<ContactMemory>& remembered) {
    const RememberedContacts memory(rows, remembered);
    for (std::size_t k = 0; k < outer.size(); ++k) {
      if (!outer.overlaps(rows, k)) continue;
      const auto i = outer.i()[k];
      const auto j = outer.j()[k];
      of_part(outer.part_of(k))
          .begin_to_touch(i, j, outer.contact_size()[k], rows.effective_mass(i, j),
                          memory.of(i, j));
    }
    memory.for_walls([&](std::uint32_t i, std::int32_t partner, const Triple<double>& u) {
      of_row(i).walls.recall(rows, i, partner, u);
    });
  }

  /// Puts rows in order of height again; contacts go with them.
  void put_in_order() {
    const auto order = rows.by_height();
    move_odd_pulls(1, 0);
    rows.reorder(order);
    move_odd_pulls(0, 1);
    std::vector<std::uint32_t> new_row(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) new_row[order[k]] = k;
    regroup_contacts(rows, blocks_, new_row,
                     [&](std::uint32_t i, std::uint32_t j) -> Block& { return home_of(i, j); });
    regroup_wall_contacts(rows, blocks_, new_row, cuts);
  }

  template <class Archive>
  void archive(Archive& a) {
    a(rows.position);
    a(rows.motion);
    a(rows.own);
    for (auto& one : rows.pull) a(one);
    a(rows.radius);
    a(rows.mass);
    a(rows.grain);
    for (Block& block : blocks_) block.archive(a);
  }

 private:
  static void move_pull(PullRow& from, PullRow& to) {
    to.force += from.force;
    from.force = Four{};
    if constexpr (Physics::turns_grains) {
      to.moment += from.moment;
      from.moment = Four{};
    }
  }

  /// Pulls on rows of odd blocks to another array.
  void move_odd_pulls(std::size_t from, std::size_t to) {
    for (std::size_t p = 1; p < cuts.count(); p += 2) {
      for (std::uint32_t i = cuts.begin(p); i < cuts.end(p); ++i) {
        move_pull(rows.pull[from][i], rows.pull[to][i]);
      }
    }
  }

  Block& home_of(std::uint32_t i, std::uint32_t j) {
    const bool large = OuterList::is_large(rows.radius[i]) || OuterList::is_large(rows.radius[j]);
    return large ? far() : blocks_[cuts.home_of(i, j)];
  }

  std::vector<Block> blocks_;
};

}  // namespace shakebed::simulator
