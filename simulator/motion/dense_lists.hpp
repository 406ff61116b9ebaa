#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "simulator/motion/dense_promises.hpp"
#include "simulator/motion/grid_row.hpp"
#include "simulator/motion/listed_pairs.hpp"
#include "simulator/motion/neighbours.hpp"
#include "simulator/motion/pairs_of_rows.hpp"

namespace shakebed::simulator {

/// Who of the grains on the time grid can touch whom before the window's end, and who flies.
///
/// Of the pairs within a skin, those are listed that may meet within the window if each of the two
/// keeps a promise: to have the velocity of a free flight, give or take some width. A grain that
/// breaks its promise makes a wider one and looks around again. Grains that are in no list fly over
/// the window at once.
template <class Physics>
class DenseLists {
 public:
  static constexpr int D = Physics::dimension;
  using Row = GridRow<Physics>;
  using PairOfGrains = std::pair<std::uint32_t, std::uint32_t>;

  std::vector<Row> rows;
  // Whether a pair touches cannot be predicted in one mixed list, and a wrong guess costs as much
  // as the force; a contact lasts some fifty steps, so that in lists kept apart it can.
  ListedPairs<D> touching;
  ListedPairs<D> candidates;                           ///< apart, but may meet within the window
  std::vector<std::vector<std::uint32_t>> near_walls;  ///< a list each; the base is the first
  std::vector<std::uint32_t> stepped;                  ///< rows that do not fly

  DenseLists(const Physics& physics, std::vector<Row> start, long step,
             std::vector<PairOfGrains> in_touch, long window_steps)
      : rows(std::move(start)),
        near_walls(wall_count(physics)),
        physics_(physics),
        search_(physics.cell),
        promises_(rows.size(), 0.05 * physics.base.peak_velocity),
        window_steps_(window_steps) {
    const std::size_t n = rows.size();
    resize(position_, n);
    wall_stamp_.assign(near_walls.size() * n, -1);
    rebuild_outer();
    mark_touching(std::move(in_touch));
    list_touching();
    make_promises();
    open_window(step);
  }

  bool window_over(long step) const { return step >= window_end_; }

  /// All rows as they are at `step`.
  void catch_up(long step) {
    const long steps = step - flown_to_;
    flown_to_ = step;
    if (steps == 0) return;
    for (const auto i : flying_) {
      if (!on_grid_[i]) rows[i].fly(steps, physics_.time_step, physics_.gravity);
    }
  }

  void open_next_window(long step) {
    catch_up(step);
    make_promises();
    if (!outer_serves()) rebuild_outer();
    list_touching();
    open_window(step);
  }

  /// Gravity was added to all velocities for one more step.
  void note_fall() { promises_.note_fall(-physics_.time_step * physics_.gravity); }

  bool breaks_promise(std::uint32_t i) const { return promises_.broken(rows[i], i); }

  /// Row i broke its promise on the way to `step`: makes a wider one and lists what it can reach.
  /// The window ends when the outer list does not reach that far.
  void look_again(std::uint32_t i, long step) {
    const double left = static_cast<double>(window_end_ - step + 1) * physics_.time_step;
    promises_.renew(rows[i], i);
    if (moved_since_build(i) + may_move(i, left) > 0.5 * skin_) window_end_ = step;
    of_rows_.for_pairs_of(i, [&](std::uint32_t k) {
      if (pair_stamp_[k] == window_) return;
      const auto& pair = outer_[k];
      wake_if_met(pair, pair.i == i ? pair.j : pair.i, k, step, left);
    });
    list_near_walls(i, physics_.base_at_step(step % physics_.steps_per_cycle), left);
  }

  static std::size_t wall_count(const Physics& physics) {
    if constexpr (Physics::walled) {
      return physics.walls.size();
    } else {
      return 1;
    }
  }

  void begin_contact(std::size_t n) {
    in_contact_[candidates[n].k] = true;
    candidates.move_to(touching, n);
  }
  void end_contact(std::size_t n) {
    in_contact_[touching[n].k] = false;
    touching.move_to(candidates, n);
  }

  std::vector<PairOfGrains> touching_pairs() const {
    std::vector<PairOfGrains> pairs;
    for (std::size_t k = 0; k < outer_.size(); ++k) {
      if (in_contact_[k]) pairs.emplace_back(outer_[k].i, outer_[k].j);
    }
    return pairs;
  }
  /// Pairs within the skin.
  const std::vector<NeighbourPair<D>>& outer() const { return outer_; }

  Vector<D> separation_of(const NeighbourPair<D>& pair) const {
    return separation(rows[pair.i], rows[pair.j], pair.shift);
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  double whole_window() const {
    return static_cast<double>(window_steps_ + 1) * physics_.time_step;
  }

  void make_promises() {
    promises_.begin_window();
    for (const auto& listed : touching) {
      promises_.note_contact(rows, outer_[listed.k].i, outer_[listed.k].j);
    }
    promises_.promise_all(rows);
  }

  double moved_since_build(std::uint32_t i) const {
    return (rows[i].position() - row(built_at_, i)).norm();
  }
  /// How far row i may go within `left` if it keeps its promise.
  double may_move(std::uint32_t i, double left) const {
    return (std::sqrt(rows[i].half_speed_squared()) + promises_.width(i) +
            largest_acceleration() * left) *
           left;
  }
  /// No free grain's velocity against the base changes faster.
  double largest_acceleration() const {
    return physics_.gravity + physics_.base.largest_acceleration();
  }

  bool outer_serves() const {
    double farthest = 0;
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
      farthest = std::max(farthest, moved_since_build(i) + may_move(i, whole_window()));
    }
    return farthest <= 0.5 * skin_;
  }

  void rebuild_outer() {
    double fastest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      fastest = std::max(fastest, rows[i].half_speed_squared());
      set_row(position_, i, rows[i].position());
    }
    fastest = 1.25 * std::sqrt(fastest) + 0.5 * physics_.base.peak_velocity;
    const double widest = 0.5 * physics_.cell.narrowest() - 2 * grain_radius;
    const double lasting = 8 * static_cast<double>(window_steps_);
    skin_ = std::clamp(2 * lasting * fastest * physics_.time_step, std::min(0.1, widest),
                       std::min(1.0, widest));
    auto before = touching_pairs();
    search_.find(position_, 2 * grain_radius + skin_, outer_);
    pair_stamp_.assign(outer_.size(), -1);
    mark_touching(std::move(before));
    of_rows_.list(rows.size(), outer_.size(), [&](std::size_t k) {
      return std::pair{outer_[k].i, outer_[k].j};
    });
    built_at_ = position_;
  }

  void mark_touching(std::vector<PairOfGrains> pairs) {
    in_contact_.assign(outer_.size(), false);
    for (auto& [i, j] : pairs) {
      if (i > j) std::swap(i, j);
    }
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t k = 0; k < outer_.size(); ++k) {
      const PairOfGrains key = std::minmax(outer_[k].i, outer_[k].j);
      in_contact_[k] = std::binary_search(pairs.begin(), pairs.end(), key);
    }
  }

  void list_touching() {
    touching.clear();
    for (std::uint32_t k = 0; k < outer_.size(); ++k) {
      if (in_contact_[k]) touching.add(listed(k));
    }
  }

  ListedPair<D> listed(std::uint32_t k) const {
    const auto& pair = outer_[k];
    return {pair.shift, static_cast<std::uint32_t>(pair.i * sizeof(Row)),
            static_cast<std::uint32_t>(pair.j * sizeof(Row)), k};
  }

  /// Beyond this distance no two rows meet within `left`.
  double reach(double left) const {
    return 2 * grain_radius + 2.01 * (promises_.fastest() + largest_acceleration() * left) * left;
  }

  void open_window(long step) {
    ++window_;
    window_end_ = step + window_steps_;
    flown_to_ = step;
    candidates.clear();
    on_grid_.assign(rows.size(), false);
    const double left = whole_window();
    const double far = reach(left) * reach(left);
    for (std::uint32_t k = 0; k < outer_.size(); ++k) {
      const auto& pair = outer_[k];
      const auto r = separation_of(pair);
      if (r.squaredNorm() > far || (!in_contact_[k] && !promises_.let_meet(pair, r, left)))
        continue;
      pair_stamp_[k] = window_;
      if (!in_contact_[k]) candidates.add(listed(k));
      on_grid_[pair.i] = on_grid_[pair.j] = true;
    }
    for (auto& near : near_walls) near.clear();
    stepped.clear();
    flying_.clear();
    const BaseState base = physics_.base_at_step(step % physics_.steps_per_cycle);
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
      if (list_near_walls(i, base, left)) on_grid_[i] = true;
      (on_grid_[i] ? stepped : flying_).push_back(i);
    }
  }

  /// Lists row i under the walls that it can reach; says whether there is one.
  bool list_near_walls(std::uint32_t i, const BaseState& base, double left) {
    const auto& row = rows[i];
    if constexpr (Physics::walled) {
      bool any = false;
      for (std::size_t w = 0; w < physics_.walls.size(); ++w) {
        const auto& wall = physics_.walls[w];
        const bool follows = wall.moves && wall.axis == wall.drive_axis;
        const double away = wall.inward * (row.half[wall.axis] - (follows ? base.velocity : 0));
        any |= list_near(w, i, physics_.overlap(wall, row.x[wall.axis], base), away, left);
      }
      return any;
    } else {
      return list_near(0, i, row.base_overlap(base), row.half[vertical] - base.velocity, left);
    }
  }

  bool list_near(std::size_t wall, std::uint32_t i, double overlap, double away, double left) {
    long& stamp = wall_stamp_[wall * rows.size() + i];
    if (stamp == window_) return true;
    const double nearing =
        std::max(-away, 0.0) + promises_.width(i) + largest_acceleration() * left;
    if (-overlap >= 1.001 * nearing * left) return false;
    stamp = window_;
    near_walls[wall].push_back(i);
    return true;
  }

  void wake_if_met(const NeighbourPair<D>& pair, std::uint32_t other, std::uint32_t k, long step,
                   double left) {
    Vector<D> r = separation_of(pair);
    const long steps = on_grid_[other] ? 0 : step - flown_to_;
    if (steps > 0) {
      const Vector<D> flown = rows[other].flown(steps, physics_.time_step, physics_.gravity);
      r += other == pair.j ? flown : Vector<D>(-flown);
    }
    if (!promises_.let_meet(pair, r, left)) return;
    pair_stamp_[k] = window_;
    candidates.add(listed(k));
    if (on_grid_[other]) return;
    rows[other].fly(steps, physics_.time_step, physics_.gravity);
    on_grid_[other] = true;
    stepped.push_back(other);
  }

  Physics physics_;
  NeighbourSearch<D> search_;
  std::vector<NeighbourPair<D>> outer_;
  std::vector<char> in_contact_;  ///< the outer pair touches at the present step
  std::vector<long> pair_stamp_;  ///< window in which the outer pair was last listed
  PairsOfRows of_rows_;
  DensePromises<Physics> promises_;
  std::vector<long> wall_stamp_;  ///< by wall and row: window in which it was last listed
  std::vector<char> on_grid_;
  std::vector<std::uint32_t> flying_;  ///< at the window's beginning
  Columns<D> position_;
  Columns<D> built_at_;
  double skin_ = 0;
  long window_steps_;
  long window_ = 0;
  long window_end_ = 0;
  long flown_to_ = 0;  ///< the step at which the flying ones are
};

}  // namespace shakebed::simulator
