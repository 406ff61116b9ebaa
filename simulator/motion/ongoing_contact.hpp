#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "simulator/motion/closed_contact.hpp"
#include "simulator/motion/stepped_contact.hpp"

namespace shakebed::simulator {

/// A contact taken in one stride: begun, its end already known, not yet over. Kept so that grains
/// can be sampled in the middle of it (about 1 % are: their velocity passes through zero there),
/// and so that it can be undone when a third body comes too near.
template <class Physics>
struct OngoingContact {
  static constexpr int D = Physics::dimension;
  static constexpr std::uint32_t with_base = std::numeric_limits<std::uint32_t>::max();
  using Motion = GrainMotion<Physics>;

  std::uint32_t i;
  std::uint32_t j;  ///< or with_base
  double start;     ///< since the epoch
  Motion before_i;
  Motion before_j;  ///< of the base contact: unused
  Motion after_i = {};
  Motion after_j = {};
  ClosedOutcome<D> outcome = {};
  EnergyLedger whole = {};          ///< what the contact does to the ledger, start to end
  EnergyLedger booked = {};         ///< what of it the run's ledger holds
  bool is_stepped = false;          ///< on the grid, and not in closed form
  long last_step_before_touch = 0;  ///< these two: of contacts that are stepped
  long first_step_after = 0;

  double end() const { return start + outcome.duration; }
  bool involves(std::uint32_t grain) const { return i == grain || j == grain; }

  struct Both {
    Motion i;
    Motion j;
  };

  /// Begins the contact on the grid, or again, to see its middle; the touch is `since_step` after
  /// the last step before it.
  SteppedContact<Physics> stepped(const Physics& physics, double since_step) const {
    const Motion a = before_i.flown(-since_step, physics.gravity);
    if (j == with_base) return {physics, a, last_step_before_touch};
    return {physics, a, before_j.flown(-since_step, physics.gravity), last_step_before_touch};
  }

  /// Both grains at time t, in closed form. Before the contact: in flight; after it: as it left
  /// them.
  Both at(double t, const ClosedContact<D, Physics::turns_grains>& contact, const Physics& physics,
          double epoch_phase) const {
    const double s = t - start;
    Both now{before_i, before_j};
    const auto motion =
        s < outcome.duration ? contact.during(outcome, std::max(s, 0.0)) : outcome.end;
    const auto change = spin_change(motion);
    now.i.spin += change;
    if (j == with_base) {
      const BaseState base = physics.base.at(
          epoch_phase + t / (physics.time_step * static_cast<double>(physics.steps_per_cycle)));
      now.i.x += std::min(s / outcome.duration, 1.0) * outcome.travel;
      now.i.x[vertical] = base.height + motion.r.norm();
      now.i.v = motion.v;
      now.i.v[vertical] += base.velocity;
      return now;
    }
    now.j.spin += change;
    const Vector<D> unwrapped = before_j.x - before_i.x - outcome.start.r;  // of the image of j
    Vector<D> centre = before_i.x + 0.5 * outcome.start.r;
    Vector<D> drift = 0.5 * (before_i.v + before_j.v);
    centre += s * drift;
    centre[vertical] -= 0.5 * physics.gravity * s * s;
    drift[vertical] -= physics.gravity * s;
    now.i.x = centre - 0.5 * motion.r;
    now.j.x = centre + 0.5 * motion.r + unwrapped;
    now.i.v = drift + 0.5 * motion.v;
    now.j.v = drift - 0.5 * motion.v;
    return now;
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  auto spin_change(const RelativeMotion<D>& motion) const {
    constexpr int S = Physics::GrainState::spin_columns;
    const double partners = j == with_base ? 1 : 2;
    if constexpr (S > 0) {
      return Eigen::Matrix<double, S, 1>((motion.spin_radius - outcome.start.spin_radius) /
                                         (partners * grain_radius));
    } else {
      (void)partners;
      return Eigen::Matrix<double, S, 1>{};
    }
  }
};

}  // namespace shakebed::simulator
