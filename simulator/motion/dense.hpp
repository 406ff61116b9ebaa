#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "simulator/motion/contact_batch.hpp"
#include "simulator/motion/grid_row.hpp"
#include "simulator/motion/neighbours.hpp"

namespace shakebed::simulator {

/// All grains on the time grid, for when many of them touch. Like the uniform engine, with lists
/// within lists: of the pairs within a skin, those that can touch in the next steps given a cap on
/// every grain's speed, and of these the ones that can in the very next few. Touching pairs have a
/// list of their own and are evaluated in batches. Grains that nothing can touch in the next few
/// steps fly over them at once. A grain that breaks its cap has the lists made again at once.
template <class Physics>
class DenseStepper {
 public:
  static constexpr int D = Physics::dimension;
  using Row = GridRow<Physics>;
  using PairOfGrains = std::pair<std::uint32_t, std::uint32_t>;

  /// Takes over the grains at `step` of the run; `touching` and `on_base` name the contacts of that
  /// step, which go on and do not begin again.
  DenseStepper(const Physics& physics, std::vector<Row> rows, long step,
               const std::vector<PairOfGrains>& touching, const std::vector<std::uint32_t>& on_base)
      : physics_(physics), rows_(std::move(rows)), search_(physics.cell), step_(step) {
    base_touched_.assign(rows_.size(), -1);
    for (const auto i : on_base) base_touched_[i] = step;
    resize(position_, rows_.size());
    rebuild_outer();
    mark_touching(touching);
    rebuild_inner();
  }

  /// Computes the contacts of the present step from full velocities, as a run begins.
  void begin(EnergyLedger& ledger) {
    for (Row& row : rows_) row.predicted = row.half;
    accumulate_contacts(ledger);
    const double h = 0.5 * physics_.time_step;
    for (Row& row : rows_) {
      for (std::size_t c = 0; c < Row::width; ++c) row.half[c] -= h * row.change[c];
    }
  }

  void step(EnergyLedger& ledger) {
    if (step_ >= inner_valid_until_ || cap_broken_) {
      catch_up();
      refresh_lists();
    } else if (step_ >= imminent_valid_until_) {
      catch_up();
      choose_imminent();
    }
    ++step_;
    const double dt = physics_.time_step;
    bool broken = false;
    for (const auto i : stepped_) {
      rows_[i].kick_drift_predict(dt, physics_.gravity);
      broken |= rows_[i].half_speed_squared() > cap_squared_[i];
    }
    cap_broken_ = broken;
    accumulate_contacts(ledger);
  }

  long touching() const { return touching_; }
  const std::vector<Row>& rows() {
    catch_up();
    return rows_;
  }

  bool on_base(std::size_t i) const { return base_touched_[i] == step_; }
  std::vector<PairOfGrains> touching_pairs() const {
    std::vector<PairOfGrains> pairs;
    for (std::size_t k = 0; k < outer_.size(); ++k) {
      if (in_contact_[k]) pairs.emplace_back(outer_[k].i, outer_[k].j);
    }
    return pairs;
  }

  double elastic_energy() {
    catch_up();
    const BaseState base = physics_.base_at_step(step_ % physics_.steps_per_cycle);
    double energy = 0;
    for (const Row& row : rows_) {
      const double overlap = row.base_overlap(base);
      if (overlap > 0) energy += physics_.grain_base.normal.stored_energy(overlap);
    }
    for (const auto& pair : outer_) {
      const double overlap = 2 * grain_radius - separation_of(pair).norm();
      if (overlap > 0) energy += physics_.grain_grain.normal.stored_energy(overlap);
    }
    return energy;
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;
  static constexpr long inner_window = 32;
  static constexpr long imminent_window = 8;

  /// A pair of the inner list, with its own copy of what the outer list knows.
  struct InnerPair {
    NeighbourPair<D> pair;
    std::uint32_t k;  ///< in outer_
  };

  /// Takes the grains that fly to the present step.
  void catch_up() {
    const long steps = step_ - flown_to_;
    flown_to_ = step_;
    if (steps == 0) return;
    for (const auto i : flying_) rows_[i].fly(steps, physics_.time_step, physics_.gravity);
  }

  void accumulate_contacts(EnergyLedger& ledger) {
    const BaseState base = physics_.base_at_step(step_ % physics_.steps_per_cycle);
    touching_ = touch_base(base, ledger);
    for (std::size_t n = 0; n < imminent_.size();) {
      const auto& inner = imminent_[n];
      if (separation_of(inner.pair).squaredNorm() < 4 * grain_radius * grain_radius) [[unlikely]] {
        in_contact_[inner.k] = true;
        ++ledger.collisions;
        move_pair(imminent_, n, touching_pairs_);
      } else {
        ++n;
      }
    }
    touch_pairs(ledger);
    touching_ += static_cast<long>(touching_pairs_.size());
  }

  long touch_base(const BaseState& base, EnergyLedger& ledger) {
    long count = 0;
    for (const auto i : near_base_) {
      const double overlap = rows_[i].base_overlap(base);
      if (overlap <= 0) continue;
      if (base_touched_[i] != step_ - 1) ++ledger.collisions;
      base_touched_[i] = step_;
      ++count;
      batch_.add_base(rows_.data(), i, base, overlap);
      if (batch_.full()) batch_.apply_base(physics_, base, rows_.data(), ledger);
    }
    batch_.apply_base(physics_, base, rows_.data(), ledger);
    return count;
  }

  void touch_pairs(EnergyLedger& ledger) {
    ended_.clear();
    std::size_t first = 0;
    const auto apply = [&] {
      batch_.apply_pairs(physics_, rows_.data(), ledger,
                         [&](std::size_t k) { ended_.push_back(first + k); });
    };
    for (std::size_t n = 0; n < touching_pairs_.size(); ++n) {
      const auto& pair = touching_pairs_[n].pair;
      batch_.add_pair(rows_.data(), pair.i, pair.j, pair.shift);
      if (!batch_.full()) continue;
      apply();
      first = n + 1;
    }
    apply();
    for (auto n = ended_.rbegin(); n != ended_.rend(); ++n) {
      in_contact_[touching_pairs_[*n].k] = false;
      move_pair(touching_pairs_, *n, imminent_);
    }
  }

  static void move_pair(std::vector<InnerPair>& from, std::size_t n, std::vector<InnerPair>& to) {
    to.push_back(from[n]);
    from[n] = from.back();
    from.pop_back();
  }

  Vector<D> separation_of(const NeighbourPair<D>& pair) const {
    return separation(rows_[pair.i], rows_[pair.j], pair.shift);
  }

  void refresh_lists() {
    double travelled = 0;
    double fastest = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      travelled = std::max(travelled, (rows_[i].position() - row(built_at_, i)).squaredNorm());
      fastest = std::max(fastest, speed_cap(i));
    }
    const double window = (inner_window + 1) * physics_.time_step;
    if (std::sqrt(travelled) + fastest * window > 0.5 * skin_) rebuild_outer();
    rebuild_inner();
  }

  /// What a grain may reach within the inner window; beyond it the lists are made again.
  double speed_cap(std::size_t i) const {
    return 1.25 * std::sqrt(rows_[i].half_speed_squared()) + 0.5 * physics_.base.peak_velocity;
  }

  void rebuild_outer() {
    double fastest = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      fastest = std::max(fastest, speed_cap(i));
      set_row(position_, i, rows_[i].position());
    }
    const double widest = 0.5 * physics_.cell.narrowest() - 2 * grain_radius;
    constexpr double lasting = 8 * inner_window;
    skin_ = std::clamp(2 * lasting * fastest * physics_.time_step, std::min(0.1, widest),
                       std::min(1.0, widest));
    const auto before = touching_pairs();
    search_.find(position_, 2 * grain_radius + skin_, outer_);
    in_contact_.assign(outer_.size(), false);
    mark_touching(before);
    built_at_ = position_;
  }

  void rebuild_inner() {
    const double window = (inner_window + 1) * physics_.time_step;
    caps_.resize(rows_.size());
    cap_squared_.resize(rows_.size());
    near_base_.clear();
    const BaseState base = physics_.base_at_step(step_ % physics_.steps_per_cycle);
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
      caps_[i] = speed_cap(i);
      cap_squared_[i] = caps_[i] * caps_[i];
      const double reach = 1.05 * (caps_[i] + physics_.base.peak_velocity) * window;
      if (-rows_[i].base_overlap(base) < reach) near_base_.push_back(i);
    }
    touching_pairs_.clear();
    candidates_.clear();
    for (std::uint32_t k = 0; k < outer_.size(); ++k) {
      if (in_contact_[k]) touching_pairs_.push_back({outer_[k], k});
      if (within_reach(outer_[k], window)) candidates_.push_back({outer_[k], k});
    }
    inner_valid_until_ = step_ + inner_window;
    cap_broken_ = false;
    choose_imminent();
  }

  bool within_reach(const NeighbourPair<D>& pair, double window) const {
    const double reach = 2 * grain_radius + 1.05 * window * (caps_[pair.i] + caps_[pair.j]);
    return separation_of(pair).squaredNorm() < reach * reach;
  }

  void choose_imminent() {
    const double window = (imminent_window + 1) * physics_.time_step;
    imminent_.clear();
    for (const auto& inner : candidates_) {
      if (!in_contact_[inner.k] && within_reach(inner.pair, window)) imminent_.push_back(inner);
    }
    imminent_valid_until_ = step_ + imminent_window;
    tell_who_flies();
  }

  /// Who is in none of the lists feels nothing but gravity until they are made again.
  void tell_who_flies() {
    on_grid_.assign(rows_.size(), false);
    for (const auto i : near_base_) on_grid_[i] = true;
    for (const auto* pairs : {&touching_pairs_, &imminent_}) {
      for (const auto& inner : *pairs) on_grid_[inner.pair.i] = on_grid_[inner.pair.j] = true;
    }
    stepped_.clear();
    flying_.clear();
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
      (on_grid_[i] ? stepped_ : flying_).push_back(i);
    }
    flown_to_ = step_;
  }

  void mark_touching(std::vector<PairOfGrains> touching) {
    for (auto& [i, j] : touching) {
      if (i > j) std::swap(i, j);
    }
    std::sort(touching.begin(), touching.end());
    for (std::size_t k = 0; k < outer_.size(); ++k) {
      const PairOfGrains key = std::minmax(outer_[k].i, outer_[k].j);
      in_contact_[k] = std::binary_search(touching.begin(), touching.end(), key);
    }
  }

  Physics physics_;
  std::vector<Row> rows_;
  NeighbourSearch<D> search_;
  long step_;
  long touching_ = 0;
  std::vector<NeighbourPair<D>> outer_;
  std::vector<char> in_contact_;  ///< the outer pair touches at the present step
  // Whether a pair touches cannot be predicted in one mixed list, and a wrong guess costs as much
  // as the force; a contact lasts some fifty steps, so that in lists kept apart it can.
  std::vector<InnerPair> touching_pairs_;
  std::vector<InnerPair> candidates_;  ///< the inner list, touching or not
  std::vector<InnerPair> imminent_;    ///< those apart that may touch before it is chosen again
  std::vector<std::size_t> ended_;
  ContactBatch<Physics> batch_;
  std::vector<std::uint32_t> near_base_;
  std::vector<char> on_grid_;
  std::vector<std::uint32_t> stepped_;
  std::vector<std::uint32_t> flying_;
  long flown_to_ = 0;  ///< the step at which the flying ones are
  std::vector<long> base_touched_;
  std::vector<double> caps_;
  std::vector<double> cap_squared_;
  Columns<D> position_;
  Columns<D> built_at_;
  double skin_ = 0;
  long inner_valid_until_ = 0;
  long imminent_valid_until_ = 0;
  bool cap_broken_ = false;
};

}  // namespace shakebed::simulator
