#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/near_walls.hpp"
#include "simulator/motion/column/outer_list.hpp"
#include "simulator/motion/column/pair_list.hpp"
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
  static constexpr bool pairs_remember =
      !std::is_empty_v<typename Physics::template PairMemory<double>>;

  RowStore rows;
  PairList<pairs_remember> touching;
  PairList<false> candidates;
  NearWalls<Physics> walls;
  std::vector<std::uint32_t> active;  ///< rows that are moved at every step
  double bed_velocity = 0;            ///< vertical, at the window's beginning
  long outer_builds = 0;

  ColumnLists(const Physics& physics, const SizedGrains& start, long step,
              const std::vector<ContactMemory>& remembered, std::int64_t held)
      : rows(start), physics_(physics), outer_(physics.cylinder.radius), held_(held) {
    const std::size_t n = rows.count();
    if (held >= 0) {  // what pushes it does not move it
      auto& own = rows.own[static_cast<std::size_t>(held)];
      own.half_velocity[3] = own.half_rim[3] = 0;
    }
    promises_.assign(n + 2, Promise{});
    free_since_.assign(n, -1);
    walls.resize_to(n);
    rows.reorder(rows.by_height());
    build_outer();
    meet_all(remembered);
    plan_window();
    open_window(step);
  }

  bool window_over(long step) const { return step >= window_end_; }
  long windows() const { return window_; }

  bool breaks_promise(std::uint32_t i, const Four& velocity) const {
    const Four promised = __builtin_convertvector(promises_[i], Four);
    const Four off = velocity - fallen_ - promised;
    const Four square = off * off;
    return square[0] + square[1] + square[2] > promised[3] * promised[3];
  }

  /// The common field was added to all velocities for one more step.
  void note_fall(const Four& change) { fallen_ += change; }

  /// The row as it is at `step`, also when it was left to fly.
  void look(std::uint32_t i, long step, SeenRow& seen, OwnRow& own) const {
    seen = rows.seen[i];
    own = rows.own[i];
    if (free_since_[i] >= 0) fly(seen, own, step - free_since_[i]);
  }

  /// Closes the present window and opens the next one.
  void open_next_window(long step) {
    for (std::uint32_t i = 0; i < rows.count(); ++i) land(i, step);
    plan_window();
    if (!outer_serves()) {
      put_in_order();
      build_outer();
      plan_window();
    }
    open_window(step);
  }

  /// Row i broke its promise on the way to `step`: makes a wider one and lists what it can reach.
  /// The window ends when the outer list does not reach that far.
  void look_again(std::uint32_t i, long step) {
    const double left = static_cast<double>(window_end_ - step + 1) * physics_.time_step;
    const double width = 2 * static_cast<double>(promises_[i][3]) + width_least;
    promises_[i] = make_promise(rows.own[i].half_velocity - fallen_, width);
    if (moved_since_build(i, step) + may_move(i, width, left) > serving * outer_.skin()) {
      window_end_ = step;
    }
    outer_.for_pairs_of(i, [&](std::uint32_t k) {
      if (pair_stamp_[k] == window_) return;
      const auto j = outer_.i()[k] == i ? outer_.j()[k] : outer_.i()[k];
      SeenRow other;
      OwnRow unused;
      look(j, step, other, unused);
      if (!in_reach(i, j, rows.seen[i].position - other.position, outer_.contact_size()[k], left)) {
        return;
      }
      wake(j, step);
      pair_stamp_[k] = window_;
      list_candidate(k);
    });
    walls.list(rows, i, physics_, physics_.base_at(step), window_, {left, promises_});
  }

  template <class Archive>
  void archive(Archive& a) {
    a(rows.seen);
    a(rows.own);
    a(rows.pull);
    a(rows.radius);
    a(rows.mass);
    a(rows.grain);
    outer_.archive(a);
    touching.archive(a);
    candidates.archive(a);
    walls.archive(a);
    a(active);
    a(bed_velocity);
    a(outer_builds);
    a(promises_);
    a(fallen_);
    a(free_since_);
    a(pair_stamp_);
    a(window_);
    a(window_begin_);
    a(window_end_);
    a(drift_);
  }

 private:
  static constexpr long window_steps = 32;
  static constexpr double serving = 0.49;      // of the skin; a half, less what one step may add
  static constexpr double width_share = 1;     // of the speed at which its contacts close, ...
  static constexpr double width_least = 0.05;  // ... and [sqrt(g d)] more

  /// A free grain k steps later: what k leapfrog steps under gravity come to.
  void fly(SeenRow& seen, OwnRow& own, long k) const {
    const auto n = static_cast<double>(k);
    const double dt = physics_.time_step;
    const double fall = -physics_.gravity * dt;
    Four v = own.half_velocity;
    v[3] = 0;
    seen.position += (n * dt) * v;
    seen.position[2] += 0.5 * n * (n + 1) * dt * fall;
    own.half_velocity[2] += n * fall;
    seen.velocity = own.half_velocity;
    seen.velocity[2] += physics_.prediction() * -physics_.gravity;
    seen.velocity[3] = 0;
  }

  void land(std::uint32_t i, long step) {
    if (free_since_[i] < 0) return;
    fly(rows.seen[i], rows.own[i], step - free_since_[i]);
    free_since_[i] = -1;
  }

  void wake(std::uint32_t i, long step) {
    if (free_since_[i] < 0) return;
    land(i, step);
    active.push_back(i);
  }

  Four relative_velocity(std::uint32_t i) const {
    Four v = rows.own[i].half_velocity;
    v[2] -= bed_velocity;
    v[3] = 0;
    return v;
  }
  double relative_speed(std::uint32_t i) const { return length(relative_velocity(i)); }
  static double length(const Four& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

  /// How far row i has come since the outer list was built, apart from the bed's own drift.
  double moved_since_build(std::uint32_t i, long step) const {
    Four moved = rows.seen[i].position - outer_.built_at()[i];
    moved[2] -=
        drift_ + static_cast<double>(step - window_begin_) * physics_.time_step * bed_velocity;
    return length(moved);
  }

  /// Sets bed velocity, drift and promises of a window that begins now.
  void plan_window() {
    const auto n = rows.count();
    double velocity = 0;
    double drift = 0;
    for (std::size_t i = 0; i < n; ++i) {
      velocity += rows.own[i].half_velocity[2];
      drift += rows.seen[i].position[2] - outer_.built_at()[i][2];
    }
    bed_velocity = velocity / static_cast<double>(n);
    drift_ = drift / static_cast<double>(n);
    make_promises();
  }

  /// Whether the outer list serves to the end of the window that was planned.
  bool outer_serves() const {
    const double left = (window_steps + 1) * physics_.time_step;
    double farthest = 0;
    for (std::uint32_t i = 0; i < rows.count(); ++i) {
      farthest = std::max(farthest, moved_since_build(i, window_begin_) +
                                        may_move(i, static_cast<double>(promises_[i][3]), left));
    }
    return farthest <= serving * outer_.skin();
  }

  void make_promises() {
    widths_.assign(rows.count(), width_least);
    for (std::size_t k = 0; k < touching.size(); ++k) {
      const auto i = touching.i()[k];
      const auto j = touching.j()[k];
      const double speed = length(rows.own[i].half_velocity - rows.own[j].half_velocity);
      const double width = width_share * speed + width_least;
      widths_[i] = std::max(widths_[i], width);
      widths_[j] = std::max(widths_[j], width);
    }
    fallen_ = Four{};
    // A held grain does not fall with the others.
    const double not_falling =
        physics_.largest_field() * static_cast<double>(window_steps + 1) * physics_.time_step;
    for (std::uint32_t i = 0; i < rows.count(); ++i) {
      const double width = widths_[i] + (rows.grain[i] == held_ ? not_falling : 0);
      promises_[i] = make_promise(rows.own[i].half_velocity, width);
    }
  }

  /// How far row i may go in the bed's frame within `left` if it keeps a promise of such a width.
  double may_move(std::uint32_t i, double width, double left) const {
    return (relative_speed(i) + width + physics_.largest_field() * left) * left;
  }

  void put_in_order() {
    const auto order = rows.by_height();
    rows.reorder(order);
    std::vector<std::uint32_t> new_row(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) new_row[order[k]] = k;
    touching.rename(new_row);
    walls.rename(new_row);
    touching.sort();
  }

  void build_outer() {
    ++outer_builds;
    outer_.build(rows, physics_.list_skin);
    pair_stamp_.assign(outer_.size(), -1);
  }

  void list_candidate(std::size_t k) {
    const auto i = outer_.i()[k];
    const auto j = outer_.j()[k];
    candidates.push(i, j, outer_.contact_size()[k], effective_mass(i, j));
  }

  double effective_mass(std::uint32_t i, std::uint32_t j) const {
    return rows.mass[i] * rows.mass[j] / (rows.mass[i] + rows.mass[j]);
  }

  bool in_reach(std::uint32_t i, std::uint32_t j, const Four& r, double size, double left) const {
    const Four a = __builtin_convertvector(promises_[i], Four);
    const Four b = __builtin_convertvector(promises_[j], Four);
    const Four w = a - b;
    const auto of = [](const Four& p, const Four& q) {
      return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    };
    return may_meet(of(r, r), of(r, w), of(w, w), size, a[3] + b[3], left);
  }

  bool overlaps(std::size_t k) const {
    const Four r = rows.seen[outer_.i()[k]].position - rows.seen[outer_.j()[k]].position;
    return outer_.contact_size()[k] - length(r) > 0;
  }

  void meet_all(const std::vector<ContactMemory>& remembered) {
    std::vector<std::uint32_t> row_of(rows.count());
    for (std::uint32_t k = 0; k < rows.count(); ++k) row_of[rows.grain[k]] = k;
    std::vector<std::pair<std::uint64_t, Triple<double>>> known;
    const auto key = [](std::uint64_t i, std::uint64_t j) { return (i << 32) + j; };
    for (const auto& one : remembered) {
      const auto i = row_of[static_cast<std::size_t>(one.i)];
      if (one.j < 0) {
        walls.recall(rows, i, one);
        continue;
      }
      const auto j = row_of[static_cast<std::size_t>(one.j)];
      known.emplace_back(key(i, j), one.u);
      known.emplace_back(key(j, i), -1.0 * one.u);
    }
    std::sort(known.begin(), known.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k < outer_.size(); ++k) {
      if (!overlaps(k)) continue;
      const auto i = outer_.i()[k];
      const auto j = outer_.j()[k];
      const auto found =
          std::lower_bound(known.begin(), known.end(), key(i, j),
                           [](const auto& a, std::uint64_t wanted) { return a.first < wanted; });
      const bool there = found != known.end() && found->first == key(i, j);
      touching.push(i, j, outer_.contact_size()[k], effective_mass(i, j),
                    there ? found->second : Triple<double>{0, 0, 0});
    }
  }

  void open_window(long step) {
    ++window_;
    window_begin_ = step;
    window_end_ = step + window_steps;
    candidates.clear();
    busy_.assign(rows.count(), !may_fly());
    for (std::size_t k = 0; k < touching.size(); ++k) {
      busy_[touching.i()[k]] = busy_[touching.j()[k]] = true;
    }
    const double left = (window_steps + 1) * physics_.time_step;
    find_meeting(rows, promises_, outer_, left, meeting_);
    for (const auto k : meeting_) {
      pair_stamp_[k] = window_;
      busy_[outer_.i()[k]] = busy_[outer_.j()[k]] = true;
      if (!overlaps(k)) list_candidate(k);
    }
    walls.relist(rows, physics_, physics_.base_at(step), window_, {left, promises_});
    active.clear();
    for (std::uint32_t i = 0; i < rows.count(); ++i) {
      if (rows.grain[i] == held_) continue;
      if (busy_[i] || walls.listed(i, window_)) {
        active.push_back(i);
      } else {
        free_since_[i] = step;
      }
    }
  }

  /// Only under constant gravity is a free flight a parabola in this frame.
  bool may_fly() const { return !physics_.drag.any() && !physics_.co_moving; }

  const Physics physics_;
  OuterList outer_;
  std::int64_t held_;  ///< a grain that does not move, or -1
  std::vector<Promise> promises_;
  std::vector<double> widths_;
  std::vector<std::uint32_t> meeting_;
  Four fallen_{};                 ///< what the common field added to velocities since the beginning
  std::vector<long> free_since_;  ///< the step at which a row was left to fly, or -1
  std::vector<long> pair_stamp_;  ///< window in which the outer pair was last listed
  std::vector<char> busy_;
  long window_ = 0;
  long window_begin_ = 0;
  long window_end_ = 0;
  double drift_ = 0;  ///< of the bed's mean height since the outer list was built, at the beginning
};

}  // namespace shakebed::simulator
