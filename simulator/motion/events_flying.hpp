#pragma once

// Grains in flight and contacts taken in one stride. Part of events.hpp.

#include "simulator/motion/events.hpp"

namespace shakebed::simulator {

template <class Physics>
void EventEngine<Physics>::advance_to(long target) {
  while (true) {
    if (dense_) {
      run_dense(target);
      if (step_ == target) break;
      continue;
    }
    const auto next = calendar_.earliest();
    if (fine_.count() > 0) {
      if (step_ == target) break;
      if (next.time <= time_of(step_ + 1)) {
        handle(next.grain, next.time);
      } else {
        step_fine();
      }
    } else {
      if (next.time > time_of(target)) break;
      handle(next.grain, next.time);
    }
  }
  step_ = target;
  if (!dense_) rebase();
}

template <class Physics>
void EventEngine<Physics>::rebase() {
  const double T = time_of(step_);
  flights_.rebase(T);
  calendar_.rebase(T);
  for (auto& contact : ongoing_) contact.start -= T;
  over_until_ = std::max(0.0, over_until_ - T);
  std::erase_if(ongoing_, [&](const Ongoing& contact) { return contact.end() <= over_until_; });
  largest_stray_ = 0;
  for (const auto& contact : ongoing_) largest_stray_ = std::max(largest_stray_, stray_[contact.i]);
  epoch_step_ = step_;
  last_event_time_ = -never;
  fastest_flight_ = flights_.fastest() + physics_.gravity * period() / 32;
}

template <class Physics>
void EventEngine<Physics>::guard_progress(double t) {
  constexpr long most_events = 100000;
  if (t > last_event_time_) {
    last_event_time_ = t;
    events_without_progress_ = 0;
  } else if (++events_without_progress_ > most_events) {
    throw files::failed("event engine", "no progress at step " + std::to_string(step_) + ": " +
                                            std::to_string(most_events) +
                                            " events without time moving on; run the scene with "
                                            "protocol.engine: uniform and report it");
  }
}

template <class Physics>
void EventEngine<Physics>::predict(std::uint32_t i, double from) {
  const auto next = search_.next_touch(i, from);
  Event event{EventKind::look_again, 0, 0};
  double time = next.recheck;
  if (next.time <= next.recheck) {
    time = next.time;
    event = {EventKind::pair, next.partner, generation_[next.partner]};
  }
  const double base_time = next_base_touch(
      flights_.position[vertical][i], flights_.velocity[vertical][i], physics_.gravity,
      physics_.base, epoch_phase(), period(), std::max(from, flights_.valid_from[i]), time);
  if (base_time < time) {
    time = base_time;
    event.kind = EventKind::base;
  }
  events_[i] = event;
  calendar_.set(i, time);
}

template <class Physics>
void EventEngine<Physics>::handle(std::uint32_t i, double t) {
  guard_progress(t);
  const Event event = events_[i];
  switch (event.kind) {
    case EventKind::look_again:
      predict(i, t);
      break;
    case EventKind::base:
      touch_base(i, t);
      break;
    case EventKind::pair:
      if (generation_[event.partner] == event.partner_generation) {
        touch_pair(i, event.partner, t);
      } else {
        predict(i, t);
      }
      break;
  }
}

template <class Physics>
void EventEngine<Physics>::touch_pair(std::uint32_t i, std::uint32_t j, double t) {
  if (contacts_ != ContactOperator::fine && take_pair_in_one_stride(i, j, t)) return;
  ++counters_.fine;
  activate(i, t);
  activate(j, t);
  look_around();
}

template <class Physics>
void EventEngine<Physics>::touch_base(std::uint32_t i, double t) {
  if (contacts_ != ContactOperator::fine && take_base_in_one_stride(i, t)) return;
  ++counters_.fine;
  activate(i, t);
  look_around();
}

template <class Physics>
GrainMotion<Physics> EventEngine<Physics>::motion_of(std::uint32_t i, double t) const {
  return {flights_.position_at(i, t), flights_.velocity_at(i, t), row(flights_.spin, i)};
}

template <class Physics>
void EventEngine<Physics>::launch(std::uint32_t i, const Motion& motion, double t) {
  flights_.set(i, motion.x, motion.v, t);
  search_.enter(i, motion.x);
  set_row(flights_.spin, i, motion.spin);
  fastest_flight_ = std::max(fastest_flight_, motion.v.norm() + physics_.gravity * period() / 32);
  ++generation_[i];
}

template <class Physics>
bool EventEngine<Physics>::take_pair_in_one_stride(std::uint32_t i, std::uint32_t j, double t) {
  Ongoing contact{i, j, t, motion_of(i, t), motion_of(j, t), {}, 0, 0, 0};
  const auto& a = contact.before_i;
  const auto& b = contact.before_j;
  RelativeMotion<D> touch{b.x - a.x, a.v - b.v, Spin<D>::Zero()};
  for (int c = 0; c < Dimension<D>::lateral; ++c) {
    touch.r[c] += physics_.cell.image_shift(c, touch.r[c]);
  }
  if constexpr (S > 0) touch.spin_radius = grain_radius * (a.spin + b.spin);

  // A grazing contact turns too far for the closed form, which is first order in the turn.
  const double closing_speed = touch.v.dot(touch.r.normalized());
  const double tangential2 = touch.v.squaredNorm() - closing_speed * closing_speed;
  constexpr double grazing = 5;
  const double duration = pair_contact_.normal().duration();
  if (closing_speed <= grazing * tangential2 * duration) return false;

  contact.outcome = pair_contact_.collide(touch);
  const auto& out = contact.outcome;
  const Vector<D> n = touch.r.normalized();
  const Vector<D> change = 0.5 * (out.end.v - out.start.v);
  const Vector<D> normal_change = change.dot(n) * n;
  const Vector<D> tangential_change = change - normal_change;
  // Changes along the two lines of centres, at touch and at the end, may cancel in their sum: to
  // second order in t_c a path can leave what the sum allows by the turn times the way covered.
  const double slack = out.travel.norm() * (out.start.v.norm() + out.end.v.norm()) * duration;
  const IsolatedGrain<D> members[] = {{i, a.x, a.v, normal_change, tangential_change, slack},
                                      {j, Vector<D>(a.x + touch.r), b.v, Vector<D>(-normal_change),
                                       Vector<D>(-tangential_change), slack}};
  if (!isolated(members, 2, t, duration)) return false;

  const auto after = contact.at(contact.end(), pair_contact_, physics_, epoch_phase());
  contact.dissipation = 0.25 * (out.start.v.squaredNorm() - out.end.v.squaredNorm());
  if constexpr (S > 0) {
    contact.dissipation += 0.5 * grain_inertia *
                           (a.spin.squaredNorm() + b.spin.squaredNorm() -
                            after.i.spin.squaredNorm() - after.j.spin.squaredNorm());
  }
  contact.steps = std::lround(duration / physics_.time_step);
  ledger_.dissipation += contact.dissipation;
  ledger_.contact_steps += contact.steps;
  ++ledger_.collisions;
  ledger_.largest_overlap =
      std::max(ledger_.largest_overlap, closing_speed * pair_contact_.normal().largest_overlap());
  ++counters_.closed;
  launch(i, after.i, contact.end());
  launch(j, after.j, contact.end());
  stray_[i] = stray_[j] = members[0].stray(duration);
  largest_stray_ = std::max(largest_stray_, stray_[i]);
  ongoing_.push_back(contact);
  predict(i, t);
  predict(j, t);
  return true;
}

template <class Physics>
bool EventEngine<Physics>::take_base_in_one_stride(std::uint32_t i, double t) {
  Ongoing contact{i, Ongoing::with_base, t, motion_of(i, t), {}, {}, 0, 0, 0};
  const auto& a = contact.before_i;
  const BaseState base = base_at(t);
  RelativeMotion<D> touch{Vector<D>::Zero(), a.v, Spin<D>::Zero()};
  touch.r[vertical] = -grain_radius;
  touch.v[vertical] -= base.velocity;
  if constexpr (S > 0) touch.spin_radius = grain_radius * a.spin;

  // Within the contact the closed form takes gravity and the base's acceleration as small.
  const double closing_speed = -touch.v[vertical];
  const double duration = base_contact_.normal().duration();
  const double omega = 2 * M_PI / period();
  constexpr double slow = 20;
  if (closing_speed <= slow * (physics_.gravity + physics_.base.peak_velocity * omega) * duration) {
    return false;
  }
  contact.outcome = base_contact_.collide(touch);
  const auto& out = contact.outcome;
  const auto after = contact.at(contact.end(), base_contact_, physics_, epoch_phase()).i;
  const double slack =
      0.5 * (physics_.gravity + physics_.base.peak_velocity * omega) * duration * duration;
  IsolatedGrain<D> member{i, a.x, a.v, Vector<D>::Zero(), after.v - a.v, slack};
  member.normal_change[vertical] = member.tangential_change[vertical];
  member.tangential_change[vertical] = 0;
  if (!isolated(&member, 1, t, duration)) return false;

  contact.dissipation = 0.5 * (out.start.v.squaredNorm() - out.end.v.squaredNorm());
  if constexpr (S > 0) {
    contact.dissipation += 0.5 * grain_inertia * (a.spin.squaredNorm() - after.spin.squaredNorm());
  }
  const double impulse = after.v[vertical] - a.v[vertical] + physics_.gravity * duration;
  contact.base_work = impulse * base_at(t + 0.5 * duration).velocity;
  contact.steps = std::lround(duration / physics_.time_step);
  ledger_.dissipation += contact.dissipation;
  ledger_.base_work += contact.base_work;
  ledger_.contact_steps += contact.steps;
  ++ledger_.collisions;
  ledger_.largest_overlap =
      std::max(ledger_.largest_overlap, closing_speed * base_contact_.normal().largest_overlap());
  ++counters_.closed;
  launch(i, after, contact.end());
  stray_[i] = member.stray(duration);
  largest_stray_ = std::max(largest_stray_, stray_[i]);
  ongoing_.push_back(contact);
  predict(i, t);
  return true;
}

/// True when no third grain, no grain on the grid and (for a pair) not the base can touch a member
/// before the contact is over, whatever any of them does that is not itself an event.
template <class Physics>
bool EventEngine<Physics>::isolated(const IsolatedGrain<D>* members, std::size_t count, double t,
                                    double duration) {
  double fastest = 0;
  Vector<D> middle = Vector<D>::Zero();
  for (std::size_t m = 0; m < count; ++m) {
    fastest = std::max(fastest, members[m].speed_bound());
    middle += members[m].x / static_cast<double>(count);
    const double gap = members[m].x[vertical] - grain_radius - physics_.base.amplitude;
    const double reach = (members[m].speed_bound() + physics_.gravity * duration) * duration;
    if (count == 2 && gap < reach) {
      const double now = members[m].x[vertical] - grain_radius - base_at(t).height;
      if (now < reach + physics_.base.peak_velocity * duration) return false;
    }
  }
  const double half_length = count == 2 ? grain_radius : 0;
  const double reach = half_length + 1 + (fastest + fastest_flight_) * duration + largest_stray_;
  search_.find_near(middle, t, reach, near_);
  const double overshoot = count == 2 ? pair_contact_.normal().largest_impulse_fraction()
                                      : base_contact_.normal().largest_impulse_fraction();
  const auto clear = [&](std::uint32_t k, const Vector<D>& x, const Vector<D>& v, double away) {
    for (std::size_t m = 0; m < count; ++m) {
      if (k == members[m].id) return true;
    }
    for (std::size_t m = 0; m < count; ++m) {
      Vector<D> r = x - members[m].x;
      for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += physics_.cell.image_shift(c, r[c]);
      const double astray = away + members[m].slack;
      // Most are too far to be met at any speed; the closer look is for the others.
      const double ball = 1 + astray + (members[m].speed_bound() + fastest_flight_) * duration;
      if (r.squaredNorm() >= ball * ball) continue;
      const Vector<D> u = v - members[m].v;
      if (least_gap(members[m], r, u, duration, overshoot, astray) <= 0) return false;
    }
    return true;
  };
  for (const auto k : near_) {
    const double astray = flights_.valid_from[k] > t ? stray_[k] : 0;
    if (!clear(k, flights_.position_at(k, t), flights_.velocity_at(k, t), astray)) return false;
  }
  for (std::size_t k = 0; k < fine_.count(); ++k) {
    const auto& row = fine_.rows[k];
    const double astray =
        (row.speed_cap + physics_.gravity * duration) * (duration + 2 * physics_.time_step);
    if (!clear(row.id, row.grain.position(), Vector<D>::Zero(), astray)) return false;
  }
  return true;
}

}  // namespace shakebed::simulator
