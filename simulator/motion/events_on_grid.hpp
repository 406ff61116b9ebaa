#pragma once

// Grains on the time grid and the hand-over to and from the dense stepper. Part of events.hpp.

#include "simulator/motion/events.hpp"

namespace shakebed::simulator {

template <class Physics>
void EventEngine<Physics>::take_out_of_flight(std::uint32_t i) {
  flights_.remove(i);
  calendar_.set(i, never);
  ++generation_[i];
}

/// Grain i, which will touch something at time t, joins the grains on the grid at the last step
/// before t. Closed contacts that end between that step and t are over: their grains go on the
/// grid on their new flights, which the next step finds apart.
template <class Physics>
void EventEngine<Physics>::activate(std::uint32_t i, double t) {
  if (fine_.count() == 0) {
    const auto last = static_cast<long>(std::ceil(t / physics_.time_step)) - 1;
    step_ = epoch_step_ + std::max(0L, last);
    fresh_.clear();
  }
  std::erase_if(ongoing_, [t](const Ongoing& contact) { return contact.end() <= t; });
  const double level = time_of(step_);
  const auto motion = motion_of(i, level);
  fine_.add(i, motion.x, motion.v, motion.spin, physics_);
  fresh_.resize(fine_.count(), false);
  fresh_.back() = true;
  take_out_of_flight(i);
}

template <class Physics>
void EventEngine<Physics>::step_fine() {
  ++step_;
  fine_.advance(physics_, base_at_step(step_), step_, ledger_);
  fresh_.assign(fine_.count(), false);
  if (fine_.touching == 0 || fine_.cap_broken || step_ >= regroup_at_) regroup();
}

/// Decides who stays on the grid: grains in contact (or about to be), and whoever could touch one
/// of them, or one of those, before the next regrouping. The others fly on.
template <class Physics>
void EventEngine<Physics>::regroup() {
  const double t = time_of(step_);
  std::vector<char> core = fresh_;
  std::vector<PairOfGrains> touching = std::exchange(undone_pairs_, {});
  for (const auto& pair : fine_.pairs) {
    if (pair.touched != step_) continue;
    core[pair.a] = core[pair.b] = true;
    touching.emplace_back(fine_.id[pair.a], fine_.id[pair.b]);
  }
  std::vector<std::uint32_t> stay;
  released_.clear();
  for (std::uint32_t k = 0; k < fine_.count(); ++k) {
    if (core[k] || fine_.base_touched[k] == step_ || near_ongoing(k)) {
      stay.push_back(k);
      continue;
    }
    launch(fine_.id[k],
           {row(fine_.grains.position, k), fine_.grains.velocity_now(k, physics_.time_step),
            fine_.grains.spin_now(k, physics_.time_step)},
           t);
    released_.push_back(fine_.id[k]);
  }
  fine_.keep(stay);
  std::vector<char> still_fresh;
  for (const auto k : stay) still_fresh.push_back(fresh_[k]);
  fresh_ = std::move(still_fresh);

  fine_.near_base = false;
  for (std::size_t k = 0; k < fine_.count(); ++k) pull_in_neighbours(k);
  touching.insert(touching.end(), undone_pairs_.begin(), undone_pairs_.end());
  undone_pairs_.clear();
  if (too_dense()) {
    enter_dense(touching);
    return;
  }
  const double window = (regroup_window + 1) * physics_.time_step;
  fine_.find_pairs(physics_.cell, [&](std::size_t a, std::size_t b) {
    return 1 + 1.05 * (fine_.speed_cap[a] + fine_.speed_cap[b]) * window;
  });
  for (auto& pair : fine_.pairs) {
    for (const auto& [i, j] : touching) {
      if ((fine_.id[pair.a] == i && fine_.id[pair.b] == j) ||
          (fine_.id[pair.a] == j && fine_.id[pair.b] == i)) {
        pair.touched = step_;
      }
    }
  }
  fine_.cap_broken = false;
  regroup_at_ = step_ + regroup_window;
  for (const auto i : released_) {
    if (flights_.present(i)) predict(i, t);
  }
}

/// Caps row k's speed and takes every flying grain within its reach onto the grid.
template <class Physics>
void EventEngine<Physics>::pull_in_neighbours(std::size_t k) {
  const double t = time_of(step_);
  const double window = (regroup_window + 1) * physics_.time_step;
  const Vector<D> x = row(fine_.grains.position, k);
  const double cap =
      1.25 * row(fine_.grains.half_velocity, k).norm() + 0.5 * physics_.base.peak_velocity;
  fine_.speed_cap[k] = cap;
  if (x[vertical] - grain_radius - physics_.base.amplitude < cap * window) fine_.near_base = true;
  // A grain in the middle of a closed contact may be elsewhere than its next flight says.
  const double stray = largest_stray();
  find_flights_near(flights_, physics_.cell, x, t,
                    1 + 1.05 * (cap + fastest_flight_) * window + stray, near_);
  const auto near = near_;
  for (const auto j : near) {
    if (!flights_.present(j)) continue;  // came along with a partner just undone
    Vector<D> r = flights_.position_at(j, t) - x;
    for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += physics_.cell.image_shift(c, r[c]);
    const bool in_contact = is_ongoing(j, t);
    const double speed = flights_.velocity_at(j, t).norm() + physics_.gravity * window;
    const double reach = 1 + 1.05 * (cap + speed) * window + (in_contact ? stray_[j] : 0);
    if (r.squaredNorm() > reach * reach) continue;
    if (in_contact) {
      undo(j);
      continue;
    }
    if (r.squaredNorm() < 1 - 1e-9 && flights_.valid_from[j] <= t) ++counters_.breaches;
    const auto motion = motion_of(j, t);
    fine_.add(j, motion.x, motion.v, motion.spin, physics_);
    fresh_.resize(fine_.count(), false);
    take_out_of_flight(j);
  }
}

template <class Physics>
bool EventEngine<Physics>::is_ongoing(std::uint32_t grain, double t) const {
  return std::any_of(ongoing_.begin(), ongoing_.end(), [&](const Ongoing& contact) {
    return contact.involves(grain) && contact.end() > t;
  });
}

/// Isolation was proven against row k as it moved on the grid; flying on, it could meet a grain in
/// the middle of a closed contact, of which flights know only the end.
template <class Physics>
bool EventEngine<Physics>::near_ongoing(std::size_t k) const {
  const double t = time_of(step_);
  const Vector<D> x = row(fine_.grains.position, k);
  const double speed = row(fine_.grains.half_velocity, k).norm();
  const auto near = [&](std::uint32_t i, double duration) {
    Vector<D> r = flights_.position_at(i, t) - x;
    for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += physics_.cell.image_shift(c, r[c]);
    const double reach =
        1 + 1.05 * (speed + flights_.velocity_at(i, t).norm()) * duration + stray_[i];
    return r.squaredNorm() < reach * reach;
  };
  return std::any_of(ongoing_.begin(), ongoing_.end(), [&](const Ongoing& contact) {
    const double left = contact.end() - t;
    if (left <= 0) return false;
    return near(contact.i, left) || (contact.j != Ongoing::with_base && near(contact.j, left));
  });
}

/// Takes back a closed contact that is under way: both partners go on the grid as they are now,
/// and the ledger keeps only what has happened.
template <class Physics>
void EventEngine<Physics>::undo(std::uint32_t grain) {
  const double t = time_of(step_);
  const auto found = std::find_if(ongoing_.begin(), ongoing_.end(), [&](const Ongoing& contact) {
    return contact.involves(grain) && contact.end() > t;
  });
  const Ongoing contact = *found;
  ongoing_.erase(found);
  ++counters_.undone;
  const bool with_base = contact.j == Ongoing::with_base;
  const auto& closed = with_base ? base_contact_ : pair_contact_;
  ledger_.dissipation -= contact.dissipation;
  ledger_.base_work -= contact.base_work;
  ledger_.contact_steps -= contact.steps;
  --ledger_.collisions;
  --counters_.closed;
  ++counters_.fine;

  const auto now = contact.at(t, closed, physics_, epoch_phase());
  const std::size_t first = fine_.add(contact.i, now.i.x, now.i.v, now.i.spin, physics_);
  take_out_of_flight(contact.i);
  if (!with_base) {
    fine_.add(contact.j, now.j.x, now.j.v, now.j.spin, physics_);
    take_out_of_flight(contact.j);
  }
  fresh_.resize(fine_.count(), true);
  if (t <= contact.start) return;

  // What the contact dissipated so far: what its kinetic energy lost beyond the spring's share.
  const double elapsed = t - contact.start;
  const auto motion = closed.during(contact.outcome, elapsed);
  const double overlap = contact.outcome.closing_speed * closed.normal().overlap(elapsed);
  const double mass = with_base ? 1 : 0.5;
  double lost = 0.5 * mass * (contact.outcome.start.v.squaredNorm() - motion.v.squaredNorm());
  if constexpr (S > 0) {
    lost += 0.5 * grain_inertia * (contact.before_i.spin.squaredNorm() - now.i.spin.squaredNorm());
    if (!with_base) {
      lost +=
          0.5 * grain_inertia * (contact.before_j.spin.squaredNorm() - now.j.spin.squaredNorm());
    }
  }
  const auto& law = with_base ? physics_.grain_base.normal : physics_.grain_grain.normal;
  ledger_.dissipation += lost - law.stored_energy(overlap);
  ++ledger_.collisions;
  if (with_base) {
    const double impulse =
        now.i.v[vertical] - contact.before_i.v[vertical] + physics_.gravity * elapsed;
    ledger_.base_work += impulse * base_at(contact.start + 0.5 * elapsed).velocity;
  }

  // The leapfrog's velocity lags by half a step of the contact force acting now.
  EnergyLedger ignored;
  auto& rows = fine_.grains;
  for (std::size_t k = first; k < fine_.count(); ++k) {
    const auto& m = k == first ? now.i : now.j;
    set_row(rows.predicted_velocity, k, m.v);
    set_row(rows.predicted_spin, k, m.spin);
  }
  if (with_base) {
    rows.touch_base(physics_, first, base_at(t), overlap, false, ignored);
    fine_.base_touched[first] = step_;
  } else {
    const Vector<D> r = motion.r;
    rows.touch_pair(physics_, first, first + 1, r, r.squaredNorm(), false, ignored);
    undone_pairs_.emplace_back(contact.i, contact.j);
  }
  const double h = 0.5 * physics_.time_step;
  for (std::size_t k = first; k < fine_.count(); ++k) {
    const auto& m = k == first ? now.i : now.j;
    set_row(rows.half_velocity, k, Vector<D>(m.v - h * row(rows.acceleration, k)));
    set_row(rows.half_spin, k, SpinRow(m.spin - h * row(rows.spin_acceleration, k)));
  }
}

template <class Physics>
void EventEngine<Physics>::enter_dense(const std::vector<PairOfGrains>& touching) {
  const double t = time_of(step_);
  while (true) {
    const auto open = std::find_if(ongoing_.begin(), ongoing_.end(),
                                   [&](const Ongoing& contact) { return contact.end() > t; });
    if (open == ongoing_.end()) break;
    undo(open->i);
  }
  ongoing_.clear();
  LeapfrogGrains<Physics> grains;
  grains.resize_to(count_);
  std::vector<std::uint32_t> on_base;
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (!flights_.present(i)) continue;
    const auto motion = motion_of(i, t);
    grains.set_flying(i, motion.x, motion.v, motion.spin, physics_);
    take_out_of_flight(i);
  }
  for (std::size_t k = 0; k < fine_.count(); ++k) {
    grains.copy_row(fine_.id[k], fine_.grains, k);
    if (fine_.base_touched[k] == step_) on_base.push_back(fine_.id[k]);
  }
  auto pairs = touching;
  pairs.insert(pairs.end(), undone_pairs_.begin(), undone_pairs_.end());
  undone_pairs_.clear();
  fine_.keep({});
  dense_.emplace(physics_, std::move(grains), step_, pairs, on_base);
}

template <class Physics>
void EventEngine<Physics>::run_dense(long target) {
  constexpr long look_every = 32;
  while (step_ < target) {
    dense_->step(ledger_);
    ++step_;
    ++counters_.dense_steps;
    if (step_ % look_every == 0 && dense_->touching() <= static_cast<long>(count_) / 10) {
      leave_dense();
      return;
    }
  }
}

template <class Physics>
void EventEngine<Physics>::leave_dense() {
  const auto& grains = dense_->grains();
  epoch_step_ = step_;
  last_event_time_ = -never;
  const auto touching = dense_->touching_pairs();
  std::vector<char> on_grid(count_, false);
  for (const auto& [i, j] : touching) on_grid[i] = on_grid[j] = true;
  fastest_flight_ = 0;
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (on_grid[i] || dense_->on_base(i)) {
      const std::size_t k = fine_.add(i, row(grains.position, i), Vector<D>::Zero(),
                                      row(grains.half_spin, i), physics_);
      fine_.grains.copy_row(k, grains, i);
      fine_.base_touched[k] = dense_->on_base(i) ? step_ : -1;
      take_out_of_flight(i);
    } else {
      launch(i,
             {row(grains.position, i), grains.velocity_now(i, physics_.time_step),
              grains.spin_now(i, physics_.time_step)},
             0);
    }
  }
  dense_.reset();
  fresh_.assign(fine_.count(), true);
  rebase();
  undone_pairs_ = touching;
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (flights_.present(i)) predict(i, 0);
  }
  if (fine_.count() > 0) regroup();
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
    const auto& grains = dense_->grains();
    for (std::uint32_t i = 0; i < count_; ++i) {
      write(i, {row(grains.position, i), grains.velocity_now(i, dt), grains.spin_now(i, dt)});
    }
    return state_;
  }
  const auto n = static_cast<std::ptrdiff_t>(count_);
  for (int c = 0; c < D; ++c) {  // the epoch is now
    std::copy_n(flights_.position[c].begin(), n, state_.position[c].begin());
    std::copy_n(flights_.velocity[c].begin(), n, state_.velocity[c].begin());
  }
  for (int c = 0; c < S; ++c) std::copy_n(flights_.spin[c].begin(), n, state_.spin[c].begin());
  for (const auto& contact : ongoing_) {
    const bool with_base = contact.j == Ongoing::with_base;
    const auto now =
        contact.at(0, with_base ? base_contact_ : pair_contact_, physics_, epoch_phase());
    write(contact.i, now.i);
    if (!with_base) write(contact.j, now.j);
  }
  for (std::size_t k = 0; k < fine_.count(); ++k) {
    write(fine_.id[k], {row(fine_.grains.position, k), fine_.grains.velocity_now(k, dt),
                        fine_.grains.spin_now(k, dt)});
  }
  return state_;
}

template <class Physics>
double EventEngine<Physics>::energy() {
  if (dense_) {
    return mechanical_energy(synchronised(), physics_.gravity) + dense_->elastic_energy();
  }
  // A flight's energy does not change, and a contact taken in one stride is booked in full at its
  // start, so that its grains count with the flights that follow it.
  double energy = fine_.elastic_energy(physics_, base_at_step(step_));
  const auto add = [&](const Motion& m) {
    energy += 0.5 * m.v.squaredNorm() + physics_.gravity * m.x[vertical] +
              0.5 * grain_inertia * m.spin.squaredNorm();
  };
  const double dt = physics_.time_step;
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (flights_.present(i)) add(motion_of(i, time_of(step_)));
  }
  for (std::size_t k = 0; k < fine_.count(); ++k) {
    add({row(fine_.grains.position, k), fine_.grains.velocity_now(k, dt),
         fine_.grains.spin_now(k, dt)});
  }
  return energy;
}

}  // namespace shakebed::simulator
