#pragma once

#include <algorithm>
#include <vector>

#include "simulator/motion/column/accelerate.hpp"
#include "simulator/motion/column/batches.hpp"
#include "simulator/motion/column/contacts_as_seen.hpp"
#include "simulator/motion/column/lists.hpp"

namespace shakebed::simulator {

/// The fast stepper of a bed in a cylinder; to rounding it moves grains as ColumnReference does.
///
/// An outer list holds pairs within a skin. From it, every few steps, the pairs that can touch
/// within the next window are chosen; of these the touching ones and the candidates are kept apart,
/// each in SIMD vectors, with the contacts' memory in the list. Grains that can touch nothing
/// within the window are left where they are and carried along their parabola when it is over.
///
/// The crew's tasks are done block by block: contacts of a step, move to the next one, look around
/// where promises were broken. What is written meanwhile is the block's own.
template <class Physics>
class ColumnStepper {
 public:
  /// A `held` grain stays where it is (in the frame of the simulation), whatever pushes it.
  ColumnStepper(const Physics& physics, const SizedGrains& start, long first_step = 0,
                const std::vector<ContactMemory>& remembered = {}, std::int64_t held = -1,
                Crew* crew = nullptr)
      : physics_(physics),
        lists_(physics, start, first_step, remembered, held, crew),
        state_(start),
        step_(first_step) {
    touch_all(0);
    for (Block& block : lists_.blocks.all()) block.counters = {};
    take_up_spill();
    const double h = 0.5 * physics_.time_step;
    for (std::uint32_t i = 0; i < rows().count(); ++i) {
      auto& own = rows().own[i];
      const PullRow& pull = lists_.blocks.pull_of(i);
      const OwnRow change = accelerations(own, pull, field_row(step_));
      own.half_velocity -= h * change.half_velocity;
      own.half_rim -= h * change.half_rim;
    }
  }

  void advance(long steps) {
    if (steps <= 0) return;
    move_all();
    for (long s = 1; s < steps; ++s) {
      if (lists_.window_over(step_)) {
        touch_all(physics_.time_step);
        move_all();
      } else {
        touch_and_move();
      }
    }
    touch_all(physics_.time_step);
    take_up_spill();
  }

  long step_number() const { return step_; }
  ContactCounters counters() const { return lists_.blocks.counters(); }
  long touching_pairs() const {
    long pairs = 0;
    for (const Block& block : lists_.blocks.all()) {
      pairs += static_cast<long>(block.touching.size());
    }
    return pairs;
  }
  long touching_walls() const {
    long contacts = 0;
    for (const Block& block : lists_.blocks.all()) contacts += block.touching_walls;
    return contacts;
  }
  const ColumnLists<Physics>& lists() const { return lists_; }

  /// Positions, velocities and spins at the present step. Leaves the motion as it is.
  const SizedGrains& synchronised() {
    const double h = 0.5 * physics_.time_step;
    for (std::uint32_t k = 0; k < rows().count(); ++k) {
      const Four place = lists_.place(k, step_);
      const OwnRow own = lists_.look(k, step_);
      const OwnRow change = accelerations(own, lists_.blocks.pull_of(k), field_row(step_));
      const Four v = own.half_velocity + h * change.half_velocity;
      const Four s = own.half_rim + h * change.half_rim;
      const std::size_t i = rows().grain[k];
      const double inverse = 1 / rows().radius[k];
      for (int c = 0; c < 3; ++c) {
        state_.position[c][i] = place[c];
        state_.velocity[c][i] = v[c];
        state_.spin[c][i] = inverse * s[c];
      }
    }
    return state_;
  }

  /// All contacts of the present step, with forces as they acted.
  std::vector<ColumnContact> contacts() const {
    return contacts_as_seen(physics_, lists_.blocks, step_);
  }
  std::vector<ColumnContact> wall_contacts() const {
    return wall_contacts_as_seen(physics_, lists_.blocks, step_);
  }

  /// Everything the motion depends on, to be written, or read back in the same order.
  template <class Archive>
  void archive(Archive& a) {
    a(step_);
    lists_.archive(a);
  }

 private:
  using Block = ColumnBlock<Physics>;

  RowStore& rows() { return lists_.blocks.rows; }
  const RowStore& rows() const { return lists_.blocks.rows; }

  Four field_row(long step) const { return Four{0, 0, physics_.field_at(step), 0}; }

  void take_up_spill() {
    lists_.blocks.share([&](Block&, std::size_t p) { lists_.blocks.take_up_spill(p); });
  }

  void move_all() {
    if (lists_.window_over(step_)) lists_.open_next_window(step_);
    const Four field = note_fall();
    lists_.blocks.share([&](Block& block, std::size_t p) { move(block, p, field); });
    arrive();
  }

  /// The contacts of this step and the move to the next one in one go through the bed: a block is
  /// moved when it and the one below have their contacts, while its rows are in the cache.
  void touch_and_move() {
    const Four field = note_fall();
    const BaseState base = physics_.base_at(step_);
    touch_far(physics_.time_step);
    lists_.blocks.share_upwards(
        [&](Block& block, std::size_t p, bool below_is_done) {
          touch(block, base, physics_.time_step);
          if (below_is_done) move(block, p, field);
        },
        [&](Block& block, std::size_t p) { move(block, p, field); });
    arrive();
  }

  Four note_fall() {
    const Four field = field_row(step_);
    lists_.promises().note_fall(physics_.time_step * field);
    return field;
  }

  /// The bed is at the next step now; those that broke their promises find whom they can reach.
  void arrive() {
    ++step_;
    if (!lists_.any_broken()) return;
    lists_.blocks.share([&](Block& block, std::size_t) { lists_.look_around(block, step_); });
    lists_.enter_found(step_);
  }

  void move(Block& block, std::size_t p, const Four& field) {
    lists_.blocks.take_up_spill(p);
    move_active(block, field);
  }

  void move_active(Block& block, const Four& field) {
    const double dt = physics_.time_step;
    const double ahead = physics_.prediction();
    auto& promises = lists_.promises();
    const Four fallen = promises.fallen();
    const OwnRow fields{field, {}};
    Four* place = rows().position.data();
    MotionRow* motion = rows().motion.data();
    OwnRow* own = rows().own.data();
    PullRow* pull = rows().pull[block.pull].data();
    block.broke_promise.clear();
    const auto& active = block.active;
    for (std::size_t first = 0; first < active.size(); first += lane_count) {
      const std::size_t count = std::min(lane_count, active.size() - first);
      Four off[lane_count] = {};
      for (std::size_t q = 0; q < count; ++q) {
        const std::uint32_t i = active[first + q];
        const Four v =
            accelerate<Physics::turns_grains>(own[i], motion[i], pull[i], fields, dt, ahead);
        place[i] += dt * v;
        off[q] = promises.off(i, v - fallen);
      }
      note_broken(block, Promises::broken(off), active.data() + first, count);
    }
  }

  [[gnu::always_inline]] void note_broken(Block& block, const LaneMask& broken,
                                          const std::uint32_t* row, std::size_t count) {
    if (std::experimental::none_of(broken)) [[likely]] {
      return;
    }
    for (std::size_t q = 0; q < count; ++q) {
      if (!broken[q]) continue;
      lists_.promises().renew(rows(), row[q]);
      block.broke_promise.push_back(row[q]);
    }
  }

  /// All contacts of the present step. Those of `far` pull rows of any block, and come first.
  void touch_all(double dt) {
    const BaseState base = physics_.base_at(step_);
    touch_far(dt);
    lists_.blocks.share([&](Block& block, std::size_t) { touch(block, base, dt); });
  }

  void touch_far(double dt) {
    touch_pairs_of(lists_.blocks.far(), dt);
    lists_.blocks.take_up_far();
  }

  void touch(Block& block, const BaseState& base, double dt) {
    if (physics_.drag.any()) add_drag(block);
    touch_pairs_of(block, dt);
    touch_walls_of(block, base, dt);
  }

  void add_drag(const Block& block) {
    const double container = physics_.lab_base_at(step_).velocity;
    for (const auto i : block.active) {
      const Four& v = rows().motion[i].velocity;
      const auto f = physics_.drag_force({v[0], v[1], v[2]}, container);
      rows().pull[block.pull][i].force += Four{f.x, f.y, f.z, 0};
    }
  }

  void touch_pairs_of(Block& block, double dt) {
    auto& touching = block.touching;
    auto& candidates = block.candidates;
    auto& changed = block.changed;
    changed.clear();
    find_begun(rows(), candidates, changed);
    for (auto k = changed.rbegin(); k != changed.rend(); ++k) {
      block.begin_to_touch(candidates.i()[*k], candidates.j()[*k], candidates.contact_size()[*k],
                           candidates.effective_mass()[*k]);
      candidates.remove(*k);
    }
    changed.clear();
    using Memory = typename Physics::template PairMemory<Lanes>;
    const auto pass = touch_pairs<Memory>(physics_.grain_grain, rows(), touching,
                                          rows().pull[block.pull].data(), dt, changed);
    for (auto k = changed.rbegin(); k != changed.rend(); ++k) {
      candidates.push(touching.i()[*k], touching.j()[*k], touching.contact_size()[*k],
                      touching.effective_mass()[*k]);
      touching.remove(*k);
    }
    block.counters.pair_steps += pass.touching;
    note(block, pass);
  }

  void touch_walls_of(Block& block, const BaseState& base, double dt) {
    using Memory = typename Physics::template WallMemory<Lanes>;
    PullRow* pull = rows().pull[block.pull].data();
    const auto low = touch_wall<Memory>(
        physics_.grain_wall, rows(), block.walls.base.list, pull, base.velocity, dt,
        [&](const LaneTriple& r, const Lanes& radius, ContactState<Lanes>& c) {
          c.normal = {Lanes(0.0), Lanes(0.0), Lanes(1.0)};
          c.overlap = Lanes(base.height) + radius - r.z;
        });
    const auto around = touch_wall<Memory>(
        physics_.grain_wall, rows(), block.walls.side.list, pull, base.velocity, dt,
        [&](const LaneTriple& r, const Lanes& radius, ContactState<Lanes>& c) {
          const Lanes rho = std::experimental::sqrt(r.x * r.x + r.y * r.y);
          const Lanes inverse = Lanes(1.0) / rho;
          c.normal = {-inverse * r.x, -inverse * r.y, Lanes(0.0)};
          c.overlap = physics_.cylinder.overlap(rho, radius);
        });
    block.touching_walls = low.touching + around.touching;
    block.counters.wall_steps += block.touching_walls;
    note(block, low);
    note(block, around);
  }

  static void note(Block& block, const PassResult& pass) {
    auto& largest = block.counters.largest_overlap;
    largest = std::max(largest, std::experimental::hmax(pass.largest_overlap));
  }

  Physics physics_;
  ColumnLists<Physics> lists_;
  SizedGrains state_;
  long step_;
};

}  // namespace shakebed::simulator
