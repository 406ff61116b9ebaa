#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "simulator/motion/column/blocks.hpp"
#include "simulator/motion/column/free_rows.hpp"
#include "simulator/motion/column/outer_list.hpp"
#include "simulator/motion/column/physics.hpp"
#include "simulator/motion/column/promise.hpp"

namespace shakebed::simulator {

/// Who can touch whom before the window's end, and which grains need not be moved until then.
///
/// Within a window every grain promises a velocity, that of a free flight, give or take some width.
/// A pair that is not listed cannot touch as long as both grains keep their promises; one that
/// breaks its own makes a new one and looks around again.
template <class Physics>
class ColumnLists {
 public:
  using Block = ColumnBlock<Physics>;

  ColumnBlocks<Physics> blocks;
  long outer_builds = 0;

  ColumnLists(const Physics& physics, const SizedGrains& start, long step,
              const std::vector<ContactMemory>& remembered, std::int64_t held, Crew* crew)
      : blocks(start, crew),
        physics_(physics),
        outer_(physics.cylinder.radius, blocks.cuts),
        held_(held),
        promises_(rows().position.size()),
        free_(rows().count(), physics.time_step, physics.gravity, physics.prediction()),
        busy_(rows().count(), false),
        busy_from_below_(rows().count(), false) {
    if (held >= 0) {  // what pushes it does not move it
      for (std::size_t k = 0; k < rows().count(); ++k) {
        if (rows().grain[k] == held) rows().own[k].half_velocity[3] = rows().own[k].half_rim[3] = 0;
      }
    }
    build_outer();
    blocks.meet_all(outer_, remembered);
    plan_window(step);
    open_window(step);
  }

  bool window_over(long step) const { return step >= window_end_; }
  long windows() const { return window_; }

  Promises& promises() { return promises_; }

  /// Where the row is and how it moves at `step`, also when it was left to fly.
  Four place(std::uint32_t i, long step) const { return free_.place(rows(), i, step); }
  OwnRow look(std::uint32_t i, long step) const { return free_.look(rows(), i, step); }

  /// Closes the present window and opens the next one.
  void open_next_window(long step) {
    blocks.share([&](Block& block, std::size_t p) {
      blocks.take_up_spill(p);
      for (std::uint32_t i = block.begin; i < block.end; ++i) free_.land(rows(), i, step);
    });
    plan_window(step);
    if (!outer_serves()) {
      blocks.put_in_order();
      build_outer();
      plan_window(step);
    }
    open_window(step);
  }

  bool any_broken() const {
    return std::any_of(blocks.all().begin(), blocks.all().end(),
                       [](const Block& block) { return !block.broke_promise.empty(); });
  }

  /// Finds what those rows of a block that broke their promises on the way to `step`, and have made
  /// wider ones, can reach. Reads of other blocks what nobody writes meanwhile.
  void look_around(Block& block, long step) {
    block.asked.clear();
    block.found.clear();
    const double left = left_at(step);
    const BaseState base = physics_.base_at(step);
    for (const auto i : block.broke_promise) {
      if (moved_since_build(i, step) + may_move(i, left) > serving * outer_.skin()) {
        block.outer_too_short = true;
      }
      outer_.for_pairs_of(i, [&](std::uint32_t k) {
        if (pair_stamp_[k] != window_) block.asked.push_back(k);
      });
      block.walls.list(rows(), i, physics_, base, window_, {left, promises_});
    }
    const auto place_of = [&](std::uint32_t i) { return place(i, step); };
    const auto& asked = block.asked;
    for (std::size_t n = 0; n < asked.size(); n += lane_count) {
      promises_.find_meeting(outer_, &asked[n], std::min(lane_count, asked.size() - n), place_of,
                             left, block.found);
    }
  }

  /// Lists what blocks have found. The window ends when the outer list does not reach far enough.
  void enter_found(long step) {
    for (Block& block : blocks.all()) {
      if (std::exchange(block.outer_too_short, false)) window_end_ = step;
      for (const auto k : block.found) {
        if (pair_stamp_[k] == window_) continue;
        pair_stamp_[k] = window_;
        wake(outer_.i()[k], step);
        wake(outer_.j()[k], step);
        list_candidate(blocks.of_part(outer_.part_of(k)), k);
      }
      block.found.clear();
    }
  }

  /// Between steps, when all spill is taken up.
  template <class Archive>
  void archive(Archive& a) {
    blocks.archive(a);
    outer_.archive(a);
    a(outer_builds);
    promises_.archive(a);
    free_.archive(a);
    a(pair_stamp_);
    a(window_);
    a(window_begin_);
    a(window_end_);
    frame_.archive(a);
  }

 private:
  RowStore& rows() { return blocks.rows; }
  const RowStore& rows() const { return blocks.rows; }

  static constexpr long window_steps = 32;
  static constexpr double serving = 0.49;  // of the skin; a half, less what one step may add

  double left_at(long step) const {
    return static_cast<double>(window_end_ - step + 1) * physics_.time_step;
  }
  double whole_window() const { return static_cast<double>(window_steps + 1) * physics_.time_step; }

  void wake(std::uint32_t i, long step) {
    if (!free_.flies(i)) return;
    free_.land(rows(), i, step);
    blocks.of_row(i).active.push_back(i);
  }

  /// How far row i has come since the outer list was built.
  double moved_since_build(std::uint32_t i, long step) const {
    const double time = static_cast<double>(step - window_begin_) * physics_.time_step;
    return frame_.way(outer_.built_at()[i], rows().position[i], time);
  }

  /// How far row i may go within `left` if it keeps its promise.
  double may_move(std::uint32_t i, double left) const {
    return (frame_.speed_of(rows().own[i].half_velocity) + promises_.width(i) +
            physics_.largest_field() * left) *
           left;
  }

  /// Sets frame and promises of a window that begins at `step`.
  void plan_window(long step) {
    window_begin_ = step;
    promises_.begin_window();
    blocks.share([&](Block& block, std::size_t) {
      promises_.forget_contacts(block.begin, block.end);
      block.velocity = block.drift = {};
      for (std::uint32_t i = block.begin; i < block.end; ++i) {
        block.velocity.take(rows().own[i].half_velocity[2]);
        block.drift.take(rows().position[i][2] - outer_.built_at()[i][2]);
      }
    });
    blocks.share([&](Block& block, std::size_t) { note_contacts(block); });
    note_contacts(blocks.far());
    Spread velocity, drift;
    for (std::size_t p = 0; p < blocks.cuts.count(); ++p) {
      velocity.take(blocks.all()[p].velocity);
      drift.take(blocks.all()[p].drift);
    }
    frame_ = {velocity.middle(), drift.middle()};
    blocks.share([&](Block& block, std::size_t) { make_promises(block); });
  }

  void note_contacts(Block& block) {
    block.spill_end = block.end;
    const auto& list = block.touching;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto i = list.i()[k];
      const auto j = list.j()[k];
      const double speed = length(rows().own[i].half_velocity - rows().own[j].half_velocity);
      promises_.note_contact(i, j, speed, block.end);
      block.note_spill(i, j);
    }
  }

  void make_promises(Block& block) {
    const double left = whole_window();
    block.farthest = 0;
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      // A held grain does not fall with the others.
      promises_.promise(rows(), i, rows().grain[i] == held_ ? physics_.largest_field() * left : 0);
      block.farthest =
          std::max(block.farthest, moved_since_build(i, window_begin_) + may_move(i, left));
    }
  }

  /// Whether the outer list serves to the end of the window that was planned.
  bool outer_serves() const {
    return std::all_of(blocks.all().begin(), blocks.all().end(), [&](const Block& block) {
      return block.farthest <= serving * outer_.skin();
    });
  }

  void build_outer() {
    ++outer_builds;
    outer_.build(rows(), physics_.list_skin, blocks.division.crew());
    pair_stamp_.assign(outer_.size(), -1);
  }

  void list_candidate(Block& block, std::size_t k) {
    const auto i = outer_.i()[k];
    const auto j = outer_.j()[k];
    block.candidates.push(i, j, outer_.contact_size()[k], rows().effective_mass(i, j));
  }

  void open_window(long step) {
    ++window_;
    window_end_ = step + window_steps;
    blocks.share([&](Block& block, std::size_t) {
      for (std::uint32_t i = block.begin; i < block.end; ++i) {
        busy_[i] = !may_fly();
        busy_from_below_[i] = false;
      }
    });
    blocks.share([&](Block& block, std::size_t p) {
      list_meeting(block, p);
      block.walls.relist(rows(), physics_, physics_.base_at(step), window_,
                         {whole_window(), promises_});
    });
    list_meeting(blocks.far(), blocks.cuts.count());
    blocks.share([&](Block& block, std::size_t) { choose_active(block, step); });
    blocks.divide_work();
  }

  void list_meeting(Block& block, std::size_t part) {
    const auto be_busy = [&](std::uint32_t i) {
      (i < block.end ? busy_ : busy_from_below_)[i] = true;
    };
    for (std::size_t k = 0; k < block.touching.size(); ++k) {
      be_busy(block.touching.i()[k]);
      be_busy(block.touching.j()[k]);
    }
    block.candidates.clear();
    auto& meeting = block.meeting;
    meeting.find(rows(), promises_, outer_, outer_.begin(part), outer_.end(part), whole_window());
    for (const auto k : meeting.touching) pair_stamp_[k] = window_;
    for (const auto k : meeting.apart) {
      pair_stamp_[k] = window_;
      be_busy(outer_.i()[k]);
      be_busy(outer_.j()[k]);
      list_candidate(block, k);
    }
  }

  void choose_active(Block& block, long step) {
    block.active.clear();
    for (std::uint32_t i = block.begin; i < block.end; ++i) {
      if (rows().grain[i] == held_) continue;
      if (busy_[i] || busy_from_below_[i] || block.walls.listed(i, window_)) {
        block.active.push_back(i);
      } else {
        free_.leave(i, step);
      }
    }
  }

  /// Only under constant gravity is a free flight a parabola in this frame.
  bool may_fly() const { return !physics_.drag.any() && !physics_.co_moving; }

  const Physics physics_;
  OuterList outer_;
  std::int64_t held_;  ///< a grain that does not move, or -1
  Promises promises_;
  FreeRows free_;
  std::vector<long> pair_stamp_;  ///< window in which the outer pair was last listed
  std::vector<char> busy_;
  std::vector<char> busy_from_below_;  ///< what the block below knows of
  long window_ = 0;
  long window_begin_ = 0;
  long window_end_ = 0;
  ListFrame frame_;
};

}  // namespace shakebed::simulator
