#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "simulator/motion/column/batches.hpp"
#include "simulator/motion/column/lists.hpp"

namespace shakebed::simulator {

/// The fast stepper of a bed in a cylinder; to rounding it moves grains as ColumnReference does.
///
/// An outer list holds pairs within a skin. From it, every few steps, the pairs that can touch
/// within the next window are chosen; of these the touching ones and the candidates are kept apart,
/// each in SIMD vectors, with the contacts' memory in the list. Grains that can touch nothing
/// within the window are left where they are and carried along their parabola when it is over.
template <class Physics>
class ColumnStepper {
 public:
  using PairMemory = typename Physics::template PairMemory<double>;
  using WallMemory = typename Physics::template WallMemory<double>;

  /// A `held` grain stays where it is (in the frame of the simulation), whatever pushes it.
  ColumnStepper(const Physics& physics, const SizedGrains& start, long first_step = 0,
                const std::vector<ContactMemory>& remembered = {}, std::int64_t held = -1)
      : physics_(physics),
        lists_(physics, start, first_step, remembered, held),
        state_(start),
        step_(first_step) {
    if (physics_.drag.any()) add_drag();
    sum_forces(0);
    counters_ = {};
    const double h = 0.5 * physics_.time_step;
    for (std::uint32_t i = 0; i < rows().count(); ++i) {
      auto& own = rows().own[i];
      own.half_velocity -= h * acceleration(i, field_row(step_));
      own.half_rim -= h * rim_acceleration(i);
    }
  }

  void advance(long steps) {
    for (long s = 0; s < steps; ++s) step();
  }

  long step_number() const { return step_; }
  const ContactCounters& counters() const { return counters_; }
  long touching_pairs() const { return static_cast<long>(lists_.touching.size()); }
  long touching_walls() const { return touching_walls_; }
  const ColumnLists<Physics>& lists() const { return lists_; }

  /// Positions, velocities and spins at the present step. Leaves the motion as it is.
  const SizedGrains& synchronised() {
    const double h = 0.5 * physics_.time_step;
    const Four field = field_row(step_);
    for (std::uint32_t k = 0; k < rows().count(); ++k) {
      SeenRow seen;
      OwnRow own;
      lists_.look(k, step_, seen, own);
      const Four v = own.half_velocity + h * acceleration(k, field);
      const Four s = own.half_rim + h * rim_acceleration(k);
      const std::size_t i = rows().grain[k];
      const double inverse = 1 / rows().radius[k];
      for (int c = 0; c < 3; ++c) {
        state_.position[c][i] = seen.position[c];
        state_.velocity[c][i] = v[c];
        state_.spin[c][i] = inverse * s[c];
      }
    }
    return state_;
  }

  /// All contacts of the present step, with forces as they acted.
  std::vector<ColumnContact> contacts() const {
    std::vector<ColumnContact> found;
    const auto& list = lists_.touching;
    for (std::size_t k = 0; k < list.size(); ++k) {
      auto i = list.i()[k];
      auto j = list.j()[k];
      auto u = list.memory_at(k);
      if (grain_of(i) > grain_of(j)) {
        std::swap(i, j);
        u = -1.0 * u;  // as seen from the other grain
      }
      found.push_back(contact_now(physics_.grain_grain, grain_of(i), grain_of(j),
                                  pair_state(seen_grain(i), seen_grain(j)),
                                  as_memory<PairMemory>(u)));
    }
    const auto walls = wall_contacts();
    found.insert(found.end(), walls.begin(), walls.end());
    return found;
  }

  std::vector<ColumnContact> wall_contacts() const {
    std::vector<ColumnContact> found;
    const BaseState base = physics_.base_at(step_);
    add_wall_contacts(found, lists_.walls.base.list, base_partner,
                      [&](const SeenGrain& grain) { return base_state(grain, base); });
    add_wall_contacts(found, lists_.walls.side.list, side_partner, [&](const SeenGrain& grain) {
      return side_state(grain, physics_.cylinder, base);
    });
    return found;
  }

  /// Everything the motion depends on, to be written, or read back in the same order.
  template <class Archive>
  void archive(Archive& a) {
    a(step_);
    a(touching_walls_);
    a(counters_.pair_steps);
    a(counters_.wall_steps);
    a(counters_.largest_overlap);
    lists_.archive(a);
  }

 private:
  RowStore& rows() { return lists_.rows; }
  const RowStore& rows() const { return lists_.rows; }

  std::int32_t grain_of(std::uint32_t row) const {
    return static_cast<std::int32_t>(rows().grain[row]);
  }

  SeenGrain seen_grain(std::uint32_t row) const {
    const auto& seen = rows().seen[row];
    const auto triple = [](const Four& f) { return Triple<double>{f[0], f[1], f[2]}; };
    return {triple(seen.position), triple(seen.velocity), triple(seen.rim_velocity),
            rows().radius[row], rows().mass[row]};
  }

  template <class Memory>
  static Memory as_memory(const Triple<double>& u) {
    if constexpr (std::is_empty_v<Memory>) {
      return {};
    } else {
      return u;
    }
  }

  template <class List, class StateOf>
  void add_wall_contacts(std::vector<ColumnContact>& found, const List& list, std::int32_t partner,
                         StateOf state_of) const {
    for (std::size_t k = 0; k < list.size; ++k) {
      const auto state = state_of(seen_grain(list.row[k]));
      if (state.overlap <= 0) continue;
      found.push_back(contact_now(physics_.grain_wall, grain_of(list.row[k]), partner, state,
                                  as_memory<WallMemory>(list.memory_at(k))));
    }
  }

  Four field_row(long step) const { return Four{0, 0, physics_.field_at(step), 0}; }

  Four acceleration(std::uint32_t i, const Four& field) const {
    Four a = rows().own[i].half_velocity[3] * rows().pull[i].force + field;
    a[3] = 0;
    return a;
  }
  /// a d(omega)/dt = -(a^2/I) sum of n x F_t.
  Four rim_acceleration(std::uint32_t i) const {
    Four b = -rows().own[i].half_rim[3] * rows().pull[i].moment;
    b[3] = 0;
    return b;
  }

  void step() {
    if (lists_.window_over(step_)) lists_.open_next_window(step_);
    broke_promise_.clear();
    move_active();
    ++step_;
    if (physics_.drag.any()) add_drag();
    for (const auto i : broke_promise_) lists_.look_again(i, step_);
    sum_forces(physics_.time_step);
  }

  void move_active() {
    const double dt = physics_.time_step;
    const double ahead = physics_.prediction();
    const Four field = field_row(step_);
    lists_.note_fall(dt * field);
    for (const auto i : lists_.active) {
      SeenRow& seen = rows().seen[i];
      OwnRow& own = rows().own[i];
      PullRow& pull = rows().pull[i];
      const Four a = acceleration(i, field);
      own.half_velocity += dt * a;
      Four v = own.half_velocity;
      v[3] = 0;
      seen.position += dt * v;
      seen.velocity = v + ahead * a;
      pull.force = Four{};
      if constexpr (Physics::turns_grains) {
        const Four b = rim_acceleration(i);
        own.half_rim += dt * b;
        Four s = own.half_rim;
        s[3] = 0;
        seen.rim_velocity = s + ahead * b;
        pull.moment = Four{};
      }
      if (lists_.breaks_promise(i, v)) [[unlikely]]
        broke_promise_.push_back(i);
    }
  }

  void add_drag() {
    const double container = physics_.lab_base_at(step_).velocity;
    for (const auto i : lists_.active) {
      const auto& v = rows().seen[i].velocity;
      const auto f = physics_.drag_force({v[0], v[1], v[2]}, container);
      rows().pull[i].force += Four{f.x, f.y, f.z, 0};
    }
  }

  void sum_forces(double dt) {
    auto& touching = lists_.touching;
    auto& candidates = lists_.candidates;
    changed_.clear();
    find_begun(rows(), candidates, changed_);
    for (auto k = changed_.rbegin(); k != changed_.rend(); ++k) {
      touching.push(candidates.i()[*k], candidates.j()[*k], candidates.contact_size()[*k],
                    candidates.effective_mass()[*k]);
      candidates.remove(*k);
    }
    changed_.clear();
    using Memory = typename Physics::template PairMemory<Lanes>;
    const auto pass = touch_pairs<Memory>(physics_.grain_grain, rows(), touching, dt, changed_);
    for (auto k = changed_.rbegin(); k != changed_.rend(); ++k) {
      candidates.push(touching.i()[*k], touching.j()[*k], touching.contact_size()[*k],
                      touching.effective_mass()[*k]);
      touching.remove(*k);
    }
    counters_.pair_steps += pass.touching;
    note(pass);
    touch_walls(dt);
    counters_.wall_steps += touching_walls_;
  }

  void touch_walls(double dt) {
    using Memory = typename Physics::template WallMemory<Lanes>;
    const BaseState base = physics_.base_at(step_);
    const auto low =
        touch_wall<Memory>(physics_.grain_wall, rows(), lists_.walls.base.list, base.velocity, dt,
                           [&](const LaneTriple& r, const Lanes& radius, ContactState<Lanes>& c) {
                             c.normal = {Lanes(0.0), Lanes(0.0), Lanes(1.0)};
                             c.overlap = Lanes(base.height) + radius - r.z;
                           });
    const auto around =
        touch_wall<Memory>(physics_.grain_wall, rows(), lists_.walls.side.list, base.velocity, dt,
                           [&](const LaneTriple& r, const Lanes& radius, ContactState<Lanes>& c) {
                             const Lanes rho = std::experimental::sqrt(r.x * r.x + r.y * r.y);
                             const Lanes inverse = Lanes(1.0) / rho;
                             c.normal = {-inverse * r.x, -inverse * r.y, Lanes(0.0)};
                             c.overlap = physics_.cylinder.overlap(rho, radius);
                           });
    touching_walls_ = low.touching + around.touching;
    note(low);
    note(around);
  }

  void note(const PassResult& pass) {
    counters_.largest_overlap =
        std::max(counters_.largest_overlap, std::experimental::hmax(pass.largest_overlap));
  }

  Physics physics_;
  ColumnLists<Physics> lists_;
  SizedGrains state_;
  long step_;
  long touching_walls_ = 0;
  ContactCounters counters_;
  std::vector<std::uint32_t> broke_promise_;
  std::vector<std::uint32_t> changed_;
};

}  // namespace shakebed::simulator
