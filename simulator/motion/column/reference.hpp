#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "simulator/motion/column/contacts_of.hpp"

namespace shakebed::simulator {

/// Reference stepper of a bed in a cylinder: leapfrog, every grain at every step, pairs from a
/// plain Verlet list, one contact after the other. Everything faster is checked against it.
template <class Physics>
class ColumnReference {
 public:
  using PairMemory = typename Physics::template PairMemory<double>;
  using WallMemory = typename Physics::template WallMemory<double>;

  ColumnReference(const Physics& physics, const SizedGrains& start, long first_step = 0,
                  const std::vector<ContactMemory>& remembered = {})
      : physics_(physics), state_(start), step_(first_step) {
    const std::size_t n = start.count();
    seen_.resize(n);
    half_velocity_.resize(n);
    half_rim_.resize(n);
    force_.resize(n);
    moment_.resize(n);
    on_base_.resize(n);
    on_side_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto x = row(start.position, i);
      const auto v = row(start.velocity, i);
      const Vector<3> s = start.radius[i] * row(start.spin, i);
      seen_[i] = {{x[0], x[1], x[2]},
                  {v[0], v[1], v[2]},
                  {s[0], s[1], s[2]},
                  start.radius[i],
                  start.mass[i]};
    }
    build_list();
    for (const auto& one : remembered) recall(one);
    sum_forces(0);
    counters_ = {};
    for (std::size_t i = 0; i < n; ++i) kick(i, -0.5 * physics_.time_step, true);
  }

  void advance(long steps) {
    for (long s = 0; s < steps; ++s) step();
  }

  long step_number() const { return step_; }
  const ContactCounters& counters() const { return counters_; }

  const SizedGrains& synchronised() {
    const double h = 0.5 * physics_.time_step;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const auto v = half_velocity_[i] + h * acceleration(i);
      const auto s = half_rim_[i] + h * rim_acceleration(i);
      const auto& x = seen_[i].position;
      const double inverse = 1 / seen_[i].radius;
      set_row(state_.position, i, Vector<3>(x.x, x.y, x.z));
      set_row(state_.velocity, i, Vector<3>(v.x, v.y, v.z));
      set_row(state_.spin, i, Vector<3>(inverse * s.x, inverse * s.y, inverse * s.z));
    }
    return state_;
  }

  long touching_pairs() const {
    return std::count_if(pairs_.begin(), pairs_.end(), [](const auto& p) { return p.touched; });
  }
  long touching_walls() const { return static_cast<long>(wall_contacts().size()); }

  /// All contacts of the present step, with forces as they acted.
  std::vector<ColumnContact> contacts() const {
    std::vector<ColumnContact> found;
    for (const auto& pair : pairs_) {
      const auto state = pair_state(seen_[pair.i], seen_[pair.j]);
      if (state.overlap <= 0) continue;
      found.push_back(contact_now(physics_.grain_grain, static_cast<std::int32_t>(pair.i),
                                  static_cast<std::int32_t>(pair.j), state, pair.memory));
    }
    const auto walls = wall_contacts();
    found.insert(found.end(), walls.begin(), walls.end());
    return found;
  }

  std::vector<ColumnContact> wall_contacts() const {
    std::vector<ColumnContact> found;
    const BaseState base = physics_.base_at(step_);
    for (std::size_t k = 0; k < seen_.size(); ++k) {
      const auto i = static_cast<std::int32_t>(k);
      const auto low = base_state(seen_[k], base);
      if (low.overlap > 0) {
        found.push_back(contact_now(physics_.grain_wall, i, base_partner, low, on_base_[k]));
      }
      const auto side = side_state(seen_[k], physics_.cylinder, base);
      if (side.overlap > 0) {
        found.push_back(contact_now(physics_.grain_wall, i, side_partner, side, on_side_[k]));
      }
    }
    return found;
  }

 private:
  struct Neighbours {
    std::uint32_t i, j;  ///< i < j
    PairMemory memory;
    bool touched;
  };

  Triple<double> acceleration(std::size_t i) const {
    Triple<double> a = (1 / seen_[i].mass) * force_[i];
    a.z += physics_.field_at(step_);
    return a;
  }
  /// a d(omega)/dt = -(a^2/I) M for the moment M = sum n x F_t.
  Triple<double> rim_acceleration(std::size_t i) const {
    return (-2.5 / seen_[i].mass) * moment_[i];
  }

  void kick(std::size_t i, double dt, bool from_full) {
    if (from_full) {
      half_velocity_[i] = seen_[i].velocity;
      half_rim_[i] = seen_[i].rim_velocity;
    }
    half_velocity_[i] += dt * acceleration(i);
    half_rim_[i] += dt * rim_acceleration(i);
  }

  void step() {
    const double dt = physics_.time_step;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const auto a = acceleration(i);
      const auto b = rim_acceleration(i);
      kick(i, dt, false);
      seen_[i].position += dt * half_velocity_[i];
      seen_[i].velocity = half_velocity_[i] + physics_.prediction() * a;
      seen_[i].rim_velocity = half_rim_[i] + physics_.prediction() * b;
    }
    ++step_;
    if (moved_too_far()) build_list();
    sum_forces(dt);
  }

  void sum_forces(double dt) {
    const BaseState base = physics_.base_at(step_);
    const double container_velocity = physics_.lab_base_at(step_).velocity;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      force_[i] = moment_[i] = {0, 0, 0};
      if (physics_.drag.any()) {
        force_[i] = physics_.drag_force(seen_[i].velocity, container_velocity);
      }
    }
    for (auto& pair : pairs_) {
      const auto state = pair_state(seen_[pair.i], seen_[pair.j]);
      pair.touched = state.overlap > 0;
      if (!pair.touched) {
        pair.memory = {};
        continue;
      }
      const auto f = physics_.grain_grain(state, pair.memory, dt);
      force_[pair.i] += f.force;
      force_[pair.j] -= f.force;
      moment_[pair.i] += f.moment;
      moment_[pair.j] += f.moment;
      ++counters_.pair_steps;
      counters_.largest_overlap = std::max(counters_.largest_overlap, state.overlap);
    }
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      touch_wall(i, base_state(seen_[i], base), on_base_[i], dt);
      touch_wall(i, side_state(seen_[i], physics_.cylinder, base), on_side_[i], dt);
    }
  }

  void touch_wall(std::size_t i, const ContactState<double>& state, WallMemory& memory, double dt) {
    if (state.overlap <= 0) {
      memory = {};
      return;
    }
    const auto f = physics_.grain_wall(state, memory, dt);
    force_[i] += f.force;
    moment_[i] += f.moment;
    ++counters_.wall_steps;
    counters_.largest_overlap = std::max(counters_.largest_overlap, state.overlap);
  }

  bool moved_too_far() const {
    double farthest = 0;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const auto moved = seen_[i].position - built_at_[i];
      farthest = std::max(farthest, dot(moved, moved));
    }
    return farthest > 0.25 * skin * skin;
  }

  void build_list() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, PairMemory> before;
    for (const auto& pair : pairs_) {
      if (pair.touched) before[{pair.i, pair.j}] = pair.memory;
    }
    pairs_.clear();
    built_at_.clear();
    for (const auto& grain : seen_) built_at_.push_back(grain.position);
    std::vector<std::uint32_t> by_height(seen_.size());
    std::iota(by_height.begin(), by_height.end(), 0U);
    std::sort(by_height.begin(), by_height.end(), [&](std::uint32_t a, std::uint32_t b) {
      return seen_[a].position.z - seen_[a].radius < seen_[b].position.z - seen_[b].radius;
    });
    for (std::size_t a = 0; a < by_height.size(); ++a) {
      const auto& low = seen_[by_height[a]];
      const double top = low.position.z + low.radius + skin;
      for (std::size_t b = a + 1; b < by_height.size(); ++b) {
        const auto& high = seen_[by_height[b]];
        if (high.position.z - high.radius > top) break;
        const auto r = low.position - high.position;
        const double reach = low.radius + high.radius + skin;
        if (dot(r, r) > reach * reach) continue;
        const auto [i, j] = std::minmax(by_height[a], by_height[b]);
        const auto known = before.find({i, j});
        const bool touched = known != before.end();
        pairs_.push_back({i, j, touched ? known->second : PairMemory{}, touched});
      }
    }
  }

  void recall(const ContactMemory& one) {
    if constexpr (!std::is_empty_v<PairMemory>) {
      for (auto& pair : pairs_) {
        const bool same = static_cast<std::int32_t>(pair.i) == one.i &&
                          static_cast<std::int32_t>(pair.j) == one.j;
        if (same) pair.memory = one.u;
      }
    }
    if constexpr (!std::is_empty_v<WallMemory>) {
      const auto i = static_cast<std::size_t>(one.i);
      if (one.j == base_partner) on_base_[i] = one.u;
      if (one.j == side_partner) on_side_[i] = one.u;
    }
  }

  static constexpr double skin = 0.3;  // [d]

  Physics physics_;
  SizedGrains state_;
  long step_;
  std::vector<SeenGrain> seen_;
  std::vector<Triple<double>> half_velocity_;
  std::vector<Triple<double>> half_rim_;
  std::vector<Triple<double>> force_;
  std::vector<Triple<double>> moment_;
  std::vector<Neighbours> pairs_;
  std::vector<WallMemory> on_base_;
  std::vector<WallMemory> on_side_;
  std::vector<Triple<double>> built_at_;
  ContactCounters counters_;
};

}  // namespace shakebed::simulator
