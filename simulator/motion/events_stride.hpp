#pragma once

// Contacts taken in one stride. Part of events.hpp.

#include "simulator/motion/events.hpp"

namespace shakebed::simulator {

template <class Physics>
bool EventEngine<Physics>::take_pair_in_one_stride(std::uint32_t i, std::uint32_t j, double t) {
  Ongoing contact{i, j, t, motion_of(i, t), motion_of(j, t)};
  const auto& a = contact.before_i;
  const auto& b = contact.before_j;
  RelativeMotion<D> touch{b.x - a.x, a.v - b.v, Spin<D>::Zero()};
  for (int c = 0; c < Dimension<D>::lateral; ++c) {
    touch.r[c] += physics_.cell.image_shift(c, touch.r[c]);
  }
  if constexpr (S > 0) touch.spin_radius = grain_radius * (a.spin + b.spin);

  // A grazing contact turns too far for the closed form, which is first order in the turn, and may
  // not last long enough to meet a step of the grid.
  const Vector<D> n = touch.r.normalized();
  const double closing_speed = touch.v.dot(n);
  const double tangential2 = touch.v.squaredNorm() - closing_speed * closing_speed;
  constexpr double grazing = 5;
  contact.is_stepped = steps_contacts() ||
                       closing_speed <= grazing * tangential2 * pair_contact_.normal().duration();
  if (!find_end(contact, touch)) return false;
  const auto& out = contact.outcome;
  const Vector<D> change = 0.5 * (out.end.v - out.start.v);
  const Vector<D> normal_change = change.dot(n) * n;
  const Vector<D> tangential_change = change - normal_change;
  // Changes along the two lines of centres, at touch and at the end, may cancel in their sum: to
  // second order in t_c a path can leave what the sum allows by the turn times the way covered.
  const double slack = out.travel.norm() * (out.start.v.norm() + out.end.v.norm()) * out.duration;
  const IsolatedGrain<D> members[] = {{i, a.x, a.v, normal_change, tangential_change, slack},
                                      {j, Vector<D>(a.x + touch.r), b.v, Vector<D>(-normal_change),
                                       Vector<D>(-tangential_change), slack}};
  if (!isolated(members, 2, t, out.duration)) return false;
  begin_stride(contact, members[0].stray(out.duration));
  return true;
}

template <class Physics>
bool EventEngine<Physics>::take_base_in_one_stride(std::uint32_t i, double t) {
  Ongoing contact{i, Ongoing::with_base, t, motion_of(i, t), {}};
  const auto& a = contact.before_i;
  RelativeMotion<D> touch{Vector<D>::Zero(), a.v, Spin<D>::Zero()};
  touch.r[vertical] = -grain_radius;
  touch.v[vertical] -= base_at(t).velocity;
  if constexpr (S > 0) touch.spin_radius = grain_radius * a.spin;

  // Within the contact the closed form takes gravity and the base's acceleration as small.
  const double bend = physics_.gravity + physics_.base.peak_velocity * 2 * M_PI / period();
  constexpr double slow = 20;
  contact.is_stepped =
      steps_contacts() || -touch.v[vertical] <= slow * bend * base_contact_.normal().duration();
  if (!find_end(contact, touch)) return false;
  const double duration = contact.outcome.duration;
  const double slack = 0.5 * bend * duration * duration;
  IsolatedGrain<D> member{i, a.x, a.v, Vector<D>::Zero(), contact.after_i.v - a.v, slack};
  member.normal_change[vertical] = member.tangential_change[vertical];
  member.tangential_change[vertical] = 0;
  if (!isolated(&member, 1, t, duration)) return false;
  begin_stride(contact, member.stray(duration));
  return true;
}

template <class Physics>
bool EventEngine<Physics>::find_end(Ongoing& contact, const RelativeMotion<D>& touch) {
  if (contact.is_stepped) return step_through(contact, touch);
  close(contact, touch);
  return true;
}

/// The contact's end by its exact solution.
template <class Physics>
void EventEngine<Physics>::close(Ongoing& contact, const RelativeMotion<D>& touch) {
  const bool with_base = contact.j == Ongoing::with_base;
  const auto& closed = with_base ? base_contact_ : pair_contact_;
  contact.outcome = closed.collide(touch);
  const auto& out = contact.outcome;
  const auto after = contact.at(contact.end(), closed, physics_, epoch_phase());
  contact.after_i = after.i;
  contact.after_j = after.j;

  auto& whole = contact.whole;
  const double mass = with_base ? 1 : 0.5;
  whole.dissipation = 0.5 * mass * (out.start.v.squaredNorm() - out.end.v.squaredNorm());
  const auto add_spin_loss = [&](const Motion& before, const Motion& then) {
    whole.dissipation +=
        0.5 * grain_inertia * (before.spin.squaredNorm() - then.spin.squaredNorm());
  };
  add_spin_loss(contact.before_i, after.i);
  if (with_base) {
    const double impulse =
        after.i.v[vertical] - contact.before_i.v[vertical] + physics_.gravity * out.duration;
    whole.base_work = impulse * base_at(contact.start + 0.5 * out.duration).velocity;
  } else {
    add_spin_loss(contact.before_j, after.j);
  }
  whole.contact_steps = std::lround(out.duration / physics_.time_step);
  whole.collisions = 1;
  whole.largest_overlap = out.closing_speed * closed.normal().largest_overlap();
  contact.booked = whole;
}

/// The contact's end by stepping it alone; false if there is no contact to speak of.
template <class Physics>
bool EventEngine<Physics>::step_through(Ongoing& contact, const RelativeMotion<D>& touch) {
  contact.last_step_before_touch = last_step_before(contact.start);
  auto stepped = step_again(contact);
  const auto& normal =
      contact.j == Ongoing::with_base ? base_contact_.normal() : pair_contact_.normal();
  constexpr double patience = 2;
  const auto most = std::lround(patience * normal.duration() / physics_.time_step) + 4;
  if (!stepped.run_until_apart(most)) return false;
  contact.first_step_after = stepped.step();
  contact.after_i = stepped.motion_i();
  contact.whole = stepped.ledger();
  auto& out = contact.outcome;
  out.duration = time_of(stepped.step()) - contact.start;
  out.start = out.end = touch;
  if (contact.j == Ongoing::with_base) return true;
  contact.after_j = stepped.motion_j();
  out.end.v = contact.after_i.v - contact.after_j.v;
  out.travel = touch.r.normalized() - stepped.apart().normalized();
  return true;
}

template <class Physics>
void EventEngine<Physics>::begin_stride(const Ongoing& contact, double stray) {
  ledger_.add(contact.booked);
  ++(contact.is_stepped ? counters_.fine : counters_.closed);
  largest_stray_ = std::max(largest_stray_, stray);
  const bool with_base = contact.j == Ongoing::with_base;
  launch(contact.i, contact.after_i, contact.end());
  stray_[contact.i] = stray;
  if (!with_base) {
    launch(contact.j, contact.after_j, contact.end());
    stray_[contact.j] = stray;
  }
  ongoing_.push_back(contact);
  predict(contact.i, contact.start);
  if (!with_base) predict(contact.j, contact.start);
}

/// Books what stepped contacts have done to the ledger up to the present step.
template <class Physics>
void EventEngine<Physics>::book_ongoing() {
  for (auto& contact : ongoing_) {
    if (contact.is_stepped) book(contact, as_it_is_now(contact).ledger());
  }
}

/// The contact on the grid, at its last step before touch.
template <class Physics>
SteppedContact<Physics> EventEngine<Physics>::step_again(const Ongoing& contact) const {
  return contact.stepped(physics_, contact.start - time_of(contact.last_step_before_touch));
}

template <class Physics>
SteppedContact<Physics> EventEngine<Physics>::as_it_is_now(const Ongoing& contact) const {
  auto stepped = step_again(contact);
  stepped.run_to(std::min(step_, contact.first_step_after));
  return stepped;
}

template <class Physics>
void EventEngine<Physics>::book(Ongoing& contact, const EnergyLedger& so_far) {
  ledger_.take_back(contact.booked);
  ledger_.add(so_far);
  contact.booked = so_far;
}

template <class Physics>
typename EventEngine<Physics>::Ongoing::Both EventEngine<Physics>::motions_now(
    const Ongoing& contact) const {
  if (contact.is_stepped) {
    const auto now = as_it_is_now(contact);
    return {now.motion_i(), now.motion_j()};
  }
  const bool with_base = contact.j == Ongoing::with_base;
  return contact.at(time_of(step_), with_base ? base_contact_ : pair_contact_, physics_,
                    epoch_phase());
}

/// Contacts that are over leave the list, and the ledger has all of them.
template <class Physics>
void EventEngine<Physics>::drop_ended() {
  std::erase_if(ongoing_, [&](Ongoing& contact) {
    if (contact.end() > over_until_) return false;
    if (contact.is_stepped) book(contact, contact.whole);
    return true;
  });
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
