#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "simulator/motion/column/block.hpp"
#include "simulator/motion/column/block_cuts.hpp"
#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/row_store.hpp"

namespace shakebed::simulator {

/// What a contact with a wall remembers.
struct WallContactOfRow {
  std::uint32_t row;
  std::int32_t partner;
  Triple<double> u;
};

/// What contacts remember of a bed that is taken up, asked for by row.
class RememberedContacts {
 public:
  RememberedContacts(const RowStore& rows, const std::vector<ContactMemory>& remembered) {
    std::vector<std::uint32_t> row_of(rows.count());
    for (std::uint32_t k = 0; k < rows.count(); ++k) row_of[rows.grain[k]] = k;
    for (const auto& one : remembered) {
      const auto i = row_of[static_cast<std::size_t>(one.i)];
      if (one.j < 0) {
        walls_.push_back({i, one.j, one.u});
        continue;
      }
      const auto j = row_of[static_cast<std::size_t>(one.j)];
      pairs_.emplace_back(key(i, j), one.u);
      pairs_.emplace_back(key(j, i), -1.0 * one.u);
    }
    std::sort(pairs_.begin(), pairs_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
  }

  /// u of the pair as seen from row i; 0 if it is not remembered.
  Triple<double> of(std::uint32_t i, std::uint32_t j) const {
    const auto found =
        std::lower_bound(pairs_.begin(), pairs_.end(), key(i, j),
                         [](const auto& a, std::uint64_t wanted) { return a.first < wanted; });
    const bool there = found != pairs_.end() && found->first == key(i, j);
    return there ? found->second : Triple<double>{0, 0, 0};
  }

  /// visit(row, partner, u)
  template <class Visit>
  void for_walls(Visit visit) const {
    for (const auto& one : walls_) visit(one.row, one.partner, one.u);
  }

 private:
  static std::uint64_t key(std::uint64_t i, std::uint64_t j) { return (i << 32) + j; }

  std::vector<std::pair<std::uint64_t, Triple<double>>> pairs_;
  std::vector<WallContactOfRow> walls_;
};

/// Rows were put in another order, row r is now called new_row[r]: contacts go with their memory to
/// the blocks that `home_of(i, j)` names, in rising order of their rows.
template <class Block, class HomeOf>
void regroup_contacts(const RowStore& rows, std::vector<Block>& blocks,
                      const std::vector<std::uint32_t>& new_row, HomeOf home_of) {
  auto all = blocks.front().touching;
  all.clear();
  for (auto& block : blocks) {
    const auto& list = block.touching;
    for (std::size_t k = 0; k < list.size(); ++k) {
      all.push(new_row[list.i()[k]], new_row[list.j()[k]], list.contact_size()[k],
               list.effective_mass()[k], list.memory_at(k));
    }
    block.touching.clear();
  }
  for (const auto k : all.sorted(rows.count())) {
    const auto i = all.i()[k];
    const auto j = all.j()[k];
    home_of(i, j).begin_to_touch(i, j, all.contact_size()[k], all.effective_mass()[k],
                                 all.memory_at(k));
  }
}

/// The same for contacts with walls.
template <class Block>
void regroup_wall_contacts(const RowStore& rows, std::vector<Block>& blocks,
                           const std::vector<std::uint32_t>& new_row, const BlockCuts& cuts) {
  std::vector<WallContactOfRow> all;
  for (auto& block : blocks) {
    block.walls.give_up([&](std::uint32_t i, std::int32_t partner, const Triple<double>& u) {
      all.push_back({new_row[i], partner, u});
    });
  }
  for (const auto& one : all) {
    blocks[cuts.block_of(one.row)].walls.recall(rows, one.row, one.partner, one.u);
  }
}

}  // namespace shakebed::simulator
