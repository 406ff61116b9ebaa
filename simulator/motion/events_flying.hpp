#pragma once

// Grains in flight, and what happens to them next. Part of events.hpp.

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
  if (!dense_ && step_ - epoch_step_ >= physics_.steps_per_cycle / epochs_per_cycle) rebase();
}

template <class Physics>
void EventEngine<Physics>::rebase() {
  const double T = time_of(step_);
  flights_.rebase(T);
  calendar_.rebase(T);
  for (auto& contact : ongoing_) contact.start -= T;
  over_until_ = std::max(0.0, over_until_ - T);
  drop_ended();
  largest_stray_ = 0;
  for (const auto& contact : ongoing_) largest_stray_ = std::max(largest_stray_, stray_[contact.i]);
  epoch_step_ = step_;
  last_event_time_ = -never;
  fastest_flight_ = flights_.fastest() + gained_in_epoch();
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
  if (take_pair_in_one_stride(i, j, t)) return;
  ++counters_.fine;
  activate(i, t);
  activate(j, t);
  look_around();
}

template <class Physics>
void EventEngine<Physics>::touch_base(std::uint32_t i, double t) {
  if (take_base_in_one_stride(i, t)) return;
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
  fastest_flight_ = std::max(fastest_flight_, motion.v.norm() + gained_in_epoch());
  ++generation_[i];
}

}  // namespace shakebed::simulator
