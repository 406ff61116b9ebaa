#pragma once

// Grains on the time grid: who comes, who stays, who goes. Part of events.hpp.

#include "simulator/motion/events.hpp"

namespace shakebed::simulator {

template <class Physics>
void EventEngine<Physics>::take_out_of_flight(std::uint32_t i) {
  flights_.remove(i);
  search_.leave(i);
  calendar_.set(i, never);
  ++generation_[i];
}

/// Grain i, which will touch something at time t, joins the grains on the grid at the last step
/// before t. Closed contacts that end between that step and t are over: their grains go on the
/// grid on their new flights, which the next step finds apart.
template <class Physics>
void EventEngine<Physics>::activate(std::uint32_t i, double t) {
  if (fine_.count() == 0) step_ = last_step_before(t);
  over_until_ = t;
  const auto motion = motion_of(i, time_of(step_));
  fine_.add(i, motion.x, motion.v, motion.spin, true, physics_);
  take_out_of_flight(i);
}

template <class Physics>
void EventEngine<Physics>::step_fine() {
  ++step_;
  fine_.advance(physics_, step_, ledger_);
  if (fine_.needs_attention) {
    release_idle();
    look_around();
  }
}

/// Lets fly whoever is not in contact and cannot come to touch anyone who is before the rows'
/// next looks around.
template <class Physics>
void EventEngine<Physics>::release_idle() {
  const double t = time_of(step_);
  fine_.mark_held(
      step_, [&](std::size_t k) { return near_ongoing(k); }, stays_);
  released_.clear();
  for (std::uint32_t k = 0; k < fine_.count(); ++k) {
    if (stays_[k]) continue;
    const auto& row = fine_.rows[k];
    const double dt = physics_.time_step;
    launch(row.id, {row.grain.position(), row.grain.velocity_now(dt), row.grain.spin_now(dt)}, t);
    released_.push_back(row.id);
  }
  if (released_.empty()) return;
  fine_.keep(stays_);
}

/// Every row whose last look has expired takes in what can touch it before the next one: a cap on
/// its speed, the base, other rows, and grains in flight, which then join the grid. Grains
/// released just before are told their next event when it is known who flies.
template <class Physics>
void EventEngine<Physics>::look_around() {
  for (std::uint32_t k = 0; k < fine_.count(); ++k) {
    if (fine_.rows[k].expires <= step_) look_around(k);
  }
  if (too_dense()) {
    released_.clear();
    enter_dense();
    return;
  }
  for (const auto i : released_) {
    if (flights_.present(i)) predict(i, time_of(step_));
  }
  released_.clear();
}

template <class Physics>
void EventEngine<Physics>::look_around(std::uint32_t k) {
  const double window = (look_window + 1) * physics_.time_step;
  auto& row = fine_.rows[k];
  row.speed_cap = 1.25 * row.grain.half_velocity().norm() + 0.5 * physics_.base.peak_velocity;
  row.expires = step_ + look_window;
  const double gap = row.grain.x[vertical] - grain_radius - physics_.base.amplitude;
  row.near_base = gap < row.speed_cap * window;
  const double cap = row.speed_cap;
  fine_.list_pairs(k, step_, physics_.cell, [&](std::size_t b) {
    return 1 + 1.05 * (cap + fine_.rows[b].speed_cap) * window;
  });
  take_in_flights(row.grain.position(), cap);
}

/// Takes every flying grain that can reach a row at x, no faster than `cap`, onto the grid.
template <class Physics>
void EventEngine<Physics>::take_in_flights(const Vector<D>& x, double cap) {
  const double t = time_of(step_);
  const double window = (look_window + 1) * physics_.time_step;
  // A grain in the middle of a closed contact may be elsewhere than its next flight says.
  search_.find_near(x, t, 1 + 1.05 * (cap + fastest_flight_) * window + largest_stray_, near_);
  for (const auto j : near_) {
    if (!flights_.present(j)) continue;  // came along with a partner just undone
    Vector<D> r = flights_.position_at(j, t) - x;
    for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += physics_.cell.image_shift(c, r[c]);
    const bool in_contact = is_ongoing(j);
    const double distance = r.norm();
    const Vector<D> v = flights_.velocity_at(j, t);
    // A flight is straight but for gravity: only what brings it nearer counts. One in the middle
    // of a contact is still to turn.
    const double approach = in_contact ? v.norm() : std::max(0.0, -v.dot(r) / distance);
    const double reach = 1 + 1.05 * (cap + approach + physics_.gravity * window) * window +
                         (in_contact ? stray_[j] : 0);
    if (distance > reach) continue;
    if (in_contact) {
      undo(j);
      continue;
    }
    if (distance < 1 - 1e-9 && flights_.valid_from[j] <= t) ++counters_.breaches;
    const auto motion = motion_of(j, t);
    fine_.add(j, motion.x, motion.v, motion.spin, false, physics_);
    take_out_of_flight(j);
  }
}

/// A closed contact lasts until its grains' next flights begin.
template <class Physics>
bool EventEngine<Physics>::is_ongoing(std::uint32_t grain) const {
  return flights_.present(grain) &&
         flights_.valid_from[grain] > std::max(time_of(step_), over_until_);
}

/// Isolation was proven against row k as it moved on the grid; flying on, it could meet a grain in
/// the middle of a closed contact, of which flights know only the end.
template <class Physics>
bool EventEngine<Physics>::near_ongoing(std::size_t k) {
  if (ongoing_.empty()) return false;
  const double t = time_of(step_);
  const Vector<D> x = fine_.rows[k].grain.position();
  const double speed = fine_.rows[k].grain.half_velocity().norm();
  const double longest =
      std::max(pair_contact_.normal().duration(), base_contact_.normal().duration());
  search_.find_near(x, t, 1 + 1.05 * (speed + fastest_flight_) * longest + largest_stray_, near_);
  return std::any_of(near_.begin(), near_.end(), [&](std::uint32_t i) {
    if (!is_ongoing(i)) return false;
    Vector<D> r = flights_.position_at(i, t) - x;
    for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += physics_.cell.image_shift(c, r[c]);
    const double left = flights_.valid_from[i] - t;
    const double reach = 1 + 1.05 * (speed + flights_.velocity_at(i, t).norm()) * left + stray_[i];
    return r.squaredNorm() < reach * reach;
  });
}

}  // namespace shakebed::simulator
