#pragma once

// Hand-over to and from the dense stepper, and the bed as others see it. Part of events.hpp.

#include "simulator/motion/events.hpp"

namespace shakebed::simulator {

/// How long the stay that now begins is at least. In a deep bed few grains may touch at an instant
/// though many are about to: all come back at once, and then they stay twice as long. Once a time
/// outside has paid for its hand-over, that is forgotten.
template <class Physics>
void EventEngine<Physics>::be_patient() {
  constexpr long paid = 8 * dense_look;
  constexpr long longest = 64 * dense_look;
  const bool in_vain = step_ - left_dense_at_ < paid;
  least_stay_ = in_vain ? std::min(2 * least_stay_, longest) : dense_look;
  entered_dense_at_ = step_;
}

template <class Physics>
void EventEngine<Physics>::enter_dense() {
  be_patient();
  ++counters_.dense_stays;
  const double t = time_of(step_);
  while (true) {
    const auto open = std::find_if(ongoing_.begin(), ongoing_.end(),
                                   [&](const Ongoing& contact) { return is_open(contact); });
    if (open == ongoing_.end()) break;
    undo(open->i);
  }
  over_until_ = std::max(over_until_, t);
  drop_ended();
  std::vector<GridRow<Physics>> rows(count_);
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (!flights_.present(i)) continue;
    const auto motion = motion_of(i, t);
    rows[i].set_flying(motion.x, motion.v, motion.spin, physics_);
    take_out_of_flight(i);
  }
  std::vector<std::uint32_t> on_base;
  for (const auto& row : fine_.rows) {
    rows[row.id] = row.grain;
    if (row.base_touched == step_) on_base.push_back(row.id);
  }
  std::vector<PairOfGrains> touching;
  for (const auto& pair : fine_.pairs) {
    if (pair.touched == step_) touching.emplace_back(fine_.rows[pair.a].id, fine_.rows[pair.b].id);
  }
  fine_.clear();
  dense_.emplace(physics_, std::move(rows), step_, touching, on_base);
}

template <class Physics>
void EventEngine<Physics>::run_dense(long target) {
  while (step_ < target) {
    dense_->step(ledger_);
    ++step_;
    ++counters_.dense_steps;
    const bool stayed = step_ - entered_dense_at_ >= least_stay_;
    if (step_ % dense_look == 0 && stayed && dilute(dense_->touching())) {
      leave_dense();
      return;
    }
  }
}

/// Grains in contact stay on the grid, the others fly.
template <class Physics>
void EventEngine<Physics>::leave_dense() {
  const auto& rows = dense_->rows();
  const double dt = physics_.time_step;
  left_dense_at_ = step_;
  epoch_step_ = step_;
  last_event_time_ = -never;
  over_until_ = -never;
  fastest_flight_ = 0;
  const auto touching = dense_->touching_pairs();
  constexpr std::uint32_t flies = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> row_of(count_, flies);
  const auto keep_on_grid = [&](std::uint32_t i) {
    if (row_of[i] != flies) return;
    row_of[i] = static_cast<std::uint32_t>(fine_.count());
    fine_.rows.push_back({rows[i], i});
    if (dense_->on_base(i)) fine_.rows.back().base_touched = step_;
    take_out_of_flight(i);
  };
  for (const auto& [i, j] : touching) {
    keep_on_grid(i);
    keep_on_grid(j);
  }
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (dense_->on_base(i)) keep_on_grid(i);
    if (row_of[i] != flies) continue;
    launch(i, {rows[i].position(), rows[i].velocity_now(dt), rows[i].spin_now(dt)}, 0);
  }
  for (const auto& [i, j] : touching) fine_.link(row_of[i], row_of[j], step_, physics_.cell);
  dense_.reset();
  rebase();
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (flights_.present(i)) predict(i, 0);
  }
  if (fine_.count() > 0) look_around();
}

template <class Physics>
const typename Physics::GrainState& EventEngine<Physics>::synchronised() {
  const auto write = [&](std::uint32_t i, const Motion& motion) {
    set_row(state_.position, i, motion.x);
    set_row(state_.velocity, i, motion.v);
    set_row(state_.spin, i, motion.spin);
  };
  const double dt = physics_.time_step;
  if (dense_) {
    const auto& rows = dense_->rows();
    for (std::uint32_t i = 0; i < count_; ++i) {
      write(i, {rows[i].position(), rows[i].velocity_now(dt), rows[i].spin_now(dt)});
    }
    return state_;
  }
  if (epoch_step_ != step_) rebase();
  const auto n = static_cast<std::ptrdiff_t>(count_);
  for (int c = 0; c < D; ++c) {
    std::copy_n(flights_.position[c].begin(), n, state_.position[c].begin());
    std::copy_n(flights_.velocity[c].begin(), n, state_.velocity[c].begin());
  }
  for (int c = 0; c < S; ++c) std::copy_n(flights_.spin[c].begin(), n, state_.spin[c].begin());
  for (const auto& contact : ongoing_) {
    const auto now = motions_now(contact);
    write(contact.i, now.i);
    if (contact.j != Ongoing::with_base) write(contact.j, now.j);
  }
  for (const auto& row : fine_.rows) {
    write(row.id, {row.grain.position(), row.grain.velocity_now(dt), row.grain.spin_now(dt)});
  }
  return state_;
}

template <class Physics>
Moments<EventEngine<Physics>::D> EventEngine<Physics>::moments() {
  if (dense_) return moments_of(synchronised());
  const double t = time_of(step_);
  auto sums = flights_.moments_at(t);
  const auto correct = [&](std::uint32_t i, const Motion& now) {
    const auto flight = motion_of(i, t);
    sums.add(flight.x[vertical], flight.v, -1);
    sums.add(now.x[vertical], now.v);
  };
  for (const auto& contact : ongoing_) {
    if (!is_open(contact)) continue;
    const auto now = motions_now(contact);
    correct(contact.i, now.i);
    if (contact.j != Ongoing::with_base) correct(contact.j, now.j);
  }
  for (const auto& row : fine_.rows) {
    sums.add(row.grain.x[vertical], row.grain.velocity_now(physics_.time_step));
  }
  return sums;
}

template <class Physics>
double EventEngine<Physics>::energy() {
  if (dense_) {
    return mechanical_energy(synchronised(), physics_.gravity) + dense_->elastic_energy();
  }
  double energy = fine_.elastic_energy(physics_, base_at_step(step_));
  const auto energy_of = [&](const Motion& m) {
    return 0.5 * m.v.squaredNorm() + physics_.gravity * m.x[vertical] +
           0.5 * grain_inertia * m.spin.squaredNorm();
  };
  const double dt = physics_.time_step;
  const double t = time_of(step_);
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (flights_.present(i)) energy += energy_of(motion_of(i, t));
  }
  // A contact in closed form is booked in full at its start: its grains count with the flights that
  // follow it. One that is stepped is booked as it goes on.
  for (const auto& contact : ongoing_) {
    if (!contact.is_stepped || contact.end() <= t) continue;
    const auto now = as_it_is_now(contact);
    energy += energy_of(now.motion_i()) - energy_of(motion_of(contact.i, t)) + now.elastic_energy();
    if (contact.j == Ongoing::with_base) continue;
    energy += energy_of(now.motion_j()) - energy_of(motion_of(contact.j, t));
  }
  for (const auto& row : fine_.rows) {
    energy += energy_of({row.grain.position(), row.grain.velocity_now(dt), row.grain.spin_now(dt)});
  }
  return energy;
}

}  // namespace shakebed::simulator
