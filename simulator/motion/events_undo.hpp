#pragma once

// Taking back a contact taken in one stride. Part of events.hpp.

#include "simulator/motion/events.hpp"

namespace shakebed::simulator {

/// Takes back a contact in one stride that is under way: both partners go on the grid as they are
/// now, and the ledger keeps only what has happened.
template <class Physics>
void EventEngine<Physics>::undo(std::uint32_t grain) {
  const auto found = std::find_if(ongoing_.begin(), ongoing_.end(), [&](const Ongoing& contact) {
    return contact.involves(grain) && is_open(contact);
  });
  const Ongoing contact = *found;
  ongoing_.erase(found);
  ++counters_.undone;
  ledger_.take_back(contact.booked);
  if (contact.is_stepped) {
    take_up_stepped(contact);
    return;
  }
  --counters_.closed;
  ++counters_.fine;
  take_up_closed(contact);
}

/// The contact goes on, on the grid, where it was on the grid.
template <class Physics>
void EventEngine<Physics>::take_up_stepped(const Ongoing& contact) {
  const auto now = as_it_is_now(contact);
  ledger_.add(now.ledger());
  const std::size_t first = fine_.count();
  fine_.rows.push_back({now.row_i(), contact.i});
  take_out_of_flight(contact.i);
  if (contact.j == Ongoing::with_base) {
    if (now.touching()) fine_.rows[first].base_touched = step_;
    return;
  }
  fine_.rows.push_back({now.row_j(), contact.j});
  take_out_of_flight(contact.j);
  if (now.touching()) fine_.link(first, first + 1, step_, physics_.cell);
}

template <class Physics>
void EventEngine<Physics>::take_up_closed(const Ongoing& contact) {
  const double t = time_of(step_);
  const bool with_base = contact.j == Ongoing::with_base;
  const auto& closed = with_base ? base_contact_ : pair_contact_;
  const auto now = contact.at(t, closed, physics_, epoch_phase());
  const std::size_t first = fine_.add(contact.i, now.i.x, now.i.v, now.i.spin, true, physics_);
  take_out_of_flight(contact.i);
  if (!with_base) {
    fine_.add(contact.j, now.j.x, now.j.v, now.j.spin, true, physics_);
    take_out_of_flight(contact.j);
  }
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
  auto& a = fine_.rows[first].grain;
  set_predicted(a, now.i);
  if (with_base) {
    simulator::touch_base(physics_, a, base_at(t), overlap, false, ignored);
    fine_.rows[first].base_touched = step_;
    set_half(a, now.i);
    return;
  }
  auto& b = fine_.rows[first + 1].grain;
  set_predicted(b, now.j);
  simulator::touch_pair(physics_, a, b, motion.r, motion.r.squaredNorm(), false, ignored);
  set_half(a, now.i);
  set_half(b, now.j);
  fine_.link(first, first + 1, step_, physics_.cell);
}

template <class Physics>
void EventEngine<Physics>::set_predicted(GridRow<Physics>& row, const Motion& now) {
  for (int c = 0; c < D; ++c) row.predicted[c] = now.v[c];
  for (int c = 0; c < S; ++c) row.predicted[GridRow<Physics>::spin_first + c] = now.spin[c];
}

template <class Physics>
void EventEngine<Physics>::set_half(GridRow<Physics>& row, const Motion& now) const {
  const double h = 0.5 * physics_.time_step;
  for (int c = 0; c < D; ++c) row.half[c] = now.v[c] - h * row.change[c];
  for (int c = 0; c < S; ++c)
    row.half[GridRow<Physics>::spin_first + c] =
        now.spin[c] - h * row.change[GridRow<Physics>::spin_first + c];
}

}  // namespace shakebed::simulator
