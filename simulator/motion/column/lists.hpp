#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/outer_list.hpp"
#include "simulator/motion/column/pair_list.hpp"
#include "simulator/motion/column/physics.hpp"
#include "simulator/motion/column/wall_list.hpp"

namespace shakebed::simulator {

/// Who can touch whom before the window's end, and which grains need not be moved until then.
///
/// Within a window every grain has a cap on its speed relative to the bed's at the window's
/// beginning; that the whole bed flies or is carried does not count, since only relative motion
/// makes contacts. A pair that is not listed cannot touch as long as both grains keep their caps.
template <class Physics>
class ColumnLists {
 public:
  static constexpr bool pairs_remember =
      !std::is_empty_v<typename Physics::template PairMemory<double>>;
  static constexpr bool walls_remember =
      !std::is_empty_v<typename Physics::template WallMemory<double>>;

  struct NearWall {
    WallList<walls_remember> list;
    std::vector<long> stamp;  ///< window in which the row was last listed

    template <class Archive>
    void archive(Archive& a) {
      list.archive(a);
      a(stamp);
    }
  };

  RowStore rows;
  PairList<pairs_remember> touching;
  PairList<false> candidates;
  NearWall base;
  NearWall side;
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
    caps_.resize(n);
    free_since_.assign(n, -1);
    base.stamp.assign(n, -1);
    side.stamp.assign(n, -1);
    rows.reorder(rows.by_height());
    build_outer();
    meet_all(remembered);
    open_window(step);
  }

  bool window_over(long step) const { return step >= window_end_; }
  long windows() const { return window_; }

  bool breaks_cap(std::uint32_t i, const Four& relative_velocity) const {
    const Four w2 = relative_velocity * relative_velocity;
    return w2[0] + w2[1] + w2[2] > caps_[i] * caps_[i];
  }

  /// The row as it is at `step`, also when it was left to fly.
  void look(std::uint32_t i, long step, SeenRow& seen, OwnRow& own) const {
    seen = rows.seen[i];
    own = rows.own[i];
    if (free_since_[i] >= 0) fly(seen, own, step - free_since_[i]);
  }

  /// Closes the present window and opens the next one.
  void open_next_window(long step) {
    for (std::uint32_t i = 0; i < rows.count(); ++i) land(i, step);
    if (!outer_serves()) {
      put_in_order();
      build_outer();
    }
    open_window(step);
  }

  /// Row i broke its cap on the way to `step`: gives it a wider one and lists what it can reach.
  /// The window ends when the outer list does not reach that far.
  void look_again(std::uint32_t i, long step) {
    const double left = static_cast<double>(window_end_ - step + 1) * physics_.time_step;
    caps_[i] = 2 * relative_speed(i) + cap_least;
    if (moved_since_build(i, step) + caps_[i] * left > serving * outer_.skin()) window_end_ = step;
    outer_.for_pairs_of(i, [&](std::uint32_t k) {
      if (pair_stamp_[k] == window_) return;
      const auto& pair = outer_.pairs()[k];
      const auto j = pair.i == i ? pair.j : pair.i;
      SeenRow other;
      OwnRow unused;
      look(j, step, other, unused);
      if (!in_reach(rows.seen[i].position, other.position, pair, left)) return;
      wake(j, step);
      pair_stamp_[k] = window_;
      list_candidate(pair);
    });
    list_walls(i, step, left);
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
    base.archive(a);
    side.archive(a);
    a(active);
    a(bed_velocity);
    a(outer_builds);
    a(caps_);
    a(free_since_);
    a(pair_stamp_);
    a(window_);
    a(window_begin_);
    a(window_end_);
    a(drift_);
  }

 private:
  static constexpr long window_steps = 32;
  static constexpr double serving = 0.49;    // of the skin; a half, less what one step may add
  static constexpr double cap_share = 1.25;  // of the present speed relative to the bed, ...
  static constexpr double cap_least = 0.15;  // ... and [sqrt(g d)] more

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

  /// Sets bed velocity, caps and drift of a window that would begin now; says whether the outer
  /// list would serve to its end.
  bool outer_serves() {
    const auto n = rows.count();
    double velocity = 0;
    double drift = 0;
    for (std::size_t i = 0; i < n; ++i) {
      velocity += rows.own[i].half_velocity[2];
      drift += rows.seen[i].position[2] - outer_.built_at()[i][2];
    }
    bed_velocity = velocity / static_cast<double>(n);
    drift_ = drift / static_cast<double>(n);
    const double left = (window_steps + 1) * physics_.time_step;
    double farthest = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      caps_[i] = cap_share * relative_speed(i) + cap_least;
      farthest = std::max(farthest, moved_since_build(i, window_begin_) + caps_[i] * left);
    }
    return farthest <= serving * outer_.skin();
  }

  void put_in_order() {
    const auto order = rows.by_height();
    rows.reorder(order);
    std::vector<std::uint32_t> new_row(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) new_row[order[k]] = k;
    touching.rename(new_row);
    for (auto* wall : {&base, &side}) {
      for (std::size_t k = 0; k < wall->list.size; ++k) {
        wall->list.row[k] = new_row[wall->list.row[k]];
      }
    }
    touching.sort();
  }

  void build_outer() {
    ++outer_builds;
    outer_.build(rows, physics_.list_skin);
    pair_stamp_.assign(outer_.pairs().size(), -1);
  }

  double contact_size(const OuterList::Pair& pair) const {
    return rows.radius[pair.i] + rows.radius[pair.j];
  }

  void list_candidate(const OuterList::Pair& pair) {
    candidates.push(pair.i, pair.j, contact_size(pair), effective_mass(pair.i, pair.j));
  }

  double effective_mass(std::uint32_t i, std::uint32_t j) const {
    return rows.mass[i] * rows.mass[j] / (rows.mass[i] + rows.mass[j]);
  }

  bool in_reach(const Four& a, const Four& b, const OuterList::Pair& pair, double left) const {
    const Four r = a - b;
    const double reach = contact_size(pair) + 1.001 * left * (caps_[pair.i] + caps_[pair.j]);
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach;
  }

  bool overlaps(const OuterList::Pair& pair) const {
    return contact_size(pair) - length(rows.seen[pair.i].position - rows.seen[pair.j].position) > 0;
  }

  void meet_all(const std::vector<ContactMemory>& remembered) {
    std::vector<std::uint32_t> row_of(rows.count());
    for (std::uint32_t k = 0; k < rows.count(); ++k) row_of[rows.grain[k]] = k;
    std::vector<std::pair<std::uint64_t, Triple<double>>> known;
    const auto key = [](std::uint64_t i, std::uint64_t j) { return (i << 32) + j; };
    for (const auto& one : remembered) {
      const auto i = row_of[static_cast<std::size_t>(one.i)];
      if (one.j == base_partner) base.list.push(i, rows.radius[i], rows.mass[i], one.u);
      if (one.j == side_partner) side.list.push(i, rows.radius[i], rows.mass[i], one.u);
      if (one.j < 0) continue;
      const auto j = row_of[static_cast<std::size_t>(one.j)];
      known.emplace_back(key(i, j), one.u);
      known.emplace_back(key(j, i), -1.0 * one.u);
    }
    std::sort(known.begin(), known.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& pair : outer_.pairs()) {
      if (!overlaps(pair)) continue;
      const auto found =
          std::lower_bound(known.begin(), known.end(), key(pair.i, pair.j),
                           [](const auto& a, std::uint64_t wanted) { return a.first < wanted; });
      const bool there = found != known.end() && found->first == key(pair.i, pair.j);
      touching.push(pair.i, pair.j, contact_size(pair), effective_mass(pair.i, pair.j),
                    there ? found->second : Triple<double>{0, 0, 0});
    }
  }

  void open_window(long step) {
    ++window_;
    window_begin_ = step;
    window_end_ = step + window_steps;
    outer_serves();
    candidates.clear();
    busy_.assign(rows.count(), !may_fly());
    for (std::size_t k = 0; k < touching.size(); ++k) {
      busy_[touching.i()[k]] = busy_[touching.j()[k]] = true;
    }
    const double left = (window_steps + 1) * physics_.time_step;
    for (std::size_t k = 0; k < outer_.pairs().size(); ++k) {
      const auto& pair = outer_.pairs()[k];
      if (!in_reach(rows.seen[pair.i].position, rows.seen[pair.j].position, pair, left)) continue;
      pair_stamp_[k] = window_;
      busy_[pair.i] = busy_[pair.j] = true;
      if (!overlaps(pair)) list_candidate(pair);
    }
    relist_walls(step, left);
    active.clear();
    for (std::uint32_t i = 0; i < rows.count(); ++i) {
      if (rows.grain[i] == held_) continue;
      if (busy_[i] || base.stamp[i] == window_ || side.stamp[i] == window_) {
        active.push_back(i);
      } else {
        free_since_[i] = step;
      }
    }
  }

  /// Only under constant gravity is a free flight a parabola in this frame.
  bool may_fly() const { return !physics_.drag.any() && !physics_.co_moving; }

  void relist_walls(long step, double left) {
    const auto old_base = base.list;
    const auto old_side = side.list;
    base.list.clear();
    side.list.clear();
    const auto keep = [&](const auto& old, NearWall& wall) {
      for (std::size_t k = 0; k < old.size; ++k) {
        const auto i = old.row[k];
        const auto u = old.memory_at(k);
        if (u.x == 0 && u.y == 0 && u.z == 0) continue;
        wall.stamp[i] = window_;
        wall.list.push(i, old.radius[k], old.mass[k], u);
      }
    };
    keep(old_base, base);
    keep(old_side, side);
    for (std::uint32_t i = 0; i < rows.count(); ++i) list_walls(i, step, left);
  }

  /// Lists row i under the walls that it can reach.
  void list_walls(std::uint32_t i, long step, double left) {
    const auto& x = rows.seen[i].position;
    const Triple<double> none{0, 0, 0};
    const BaseState now = physics_.base_at(step);
    // The base's speed changes by less than A omega^2 dt a step.
    const double of_base = std::abs(bed_velocity - now.velocity) + base_acceleration() * left;
    if (base.stamp[i] != window_ &&
        x[2] - rows.radius[i] - now.height < (caps_[i] + of_base) * left) {
      base.stamp[i] = window_;
      base.list.push(i, rows.radius[i], rows.mass[i], none);
    }
    const double inside = physics_.cylinder.radius - rows.radius[i] - caps_[i] * left;
    if (side.stamp[i] != window_ && (inside < 0 || x[0] * x[0] + x[1] * x[1] > inside * inside)) {
      side.stamp[i] = window_;
      side.list.push(i, rows.radius[i], rows.mass[i], none);
    }
  }

  double base_acceleration() const {
    const auto& drive = physics_.base;
    return drive.amplitude == 0 ? 0 : drive.peak_velocity * drive.peak_velocity / drive.amplitude;
  }

  const Physics physics_;
  OuterList outer_;
  std::int64_t held_;  ///< a grain that does not move, or -1
  std::vector<double> caps_;
  std::vector<long> free_since_;  ///< the step at which a row was left to fly, or -1
  std::vector<long> pair_stamp_;  ///< window in which the outer pair was last listed
  std::vector<char> busy_;
  long window_ = 0;
  long window_begin_ = 0;
  long window_end_ = 0;
  double drift_ = 0;  ///< of the bed's mean height since the outer list was built, at the beginning
};

}  // namespace shakebed::simulator
