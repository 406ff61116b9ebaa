#pragma once

#include <cmath>
#include <numbers>

#include "simulator/boundary/base.hpp"
#include "simulator/boundary/cylinder.hpp"
#include "simulator/contact/spring_contact.hpp"
#include "simulator/grains/sized_grains.hpp"

namespace shakebed::simulator {

/// Drag on each grain. Background damping is -b v in the lab frame (Sun 2006, Eq. 7). Interstitial
/// air is -b times the slip against a gas that one-dimensional continuity moves: in a container
/// closed below, phi v_s + (1 - phi) v_gas = v_container, so that the vertical slip is
/// (v - v_container)/(1 - phi), and laterally the gas rests. (The paper gives no gas velocity: the
/// closure and phi, one number for the whole bed, are ours.)
struct Drag {
  double background = 0;            ///< b [m sqrt(g/d)]
  double air = 0;                   ///< b of the air [m sqrt(g/d)]
  double air_packing_fraction = 0;  ///< phi

  bool any() const { return background != 0 || air != 0; }
  double lateral_rate() const { return background + air; }
  double vertical_air_rate() const { return air / (1 - air_packing_fraction); }
};

/// Everything the motion of grains in a shaken cylinder needs beside the grains, bound once.
/// In the co-moving frame the container rests and the field is -g - d^2 z_b/dt^2.
template <class OverlapLaw, class PairTangential, class WallTangential>
struct ColumnPhysics {
  using Overlap = OverlapLaw;
  using Pair = SpringContact<OverlapLaw, PairTangential>;
  using Wall = SpringContact<OverlapLaw, WallTangential>;
  static constexpr bool turns_grains = Pair::turns_grains || Wall::turns_grains;
  template <class Real>
  using PairMemory = typename PairTangential::template Memory<Real>;
  template <class Real>
  using WallMemory = typename WallTangential::template Memory<Real>;

  Pair grain_grain;
  Wall grain_wall;
  Cylinder cylinder;
  BaseMotion base;  ///< of base and side wall together
  Drag drag;
  double gravity;
  double time_step;
  long steps_per_cycle;
  bool co_moving = false;
  /// Velocities in contact laws are those of step n - 1/2 carried on by a(n-1) dt/2, to the time
  /// of the positions; without it, those of n - 1/2 themselves, as LAMMPS has them.
  bool predict_velocities = true;
  double list_skin = 0.5;  ///< of OuterList [d]

  double prediction() const { return predict_velocities ? 0.5 * time_step : 0; }

  BaseState lab_base_at(long step) const {
    return base.at(static_cast<double>(step % steps_per_cycle) /
                   static_cast<double>(steps_per_cycle));
  }
  /// Base and side wall in the frame of the simulation.
  BaseState base_at(long step) const { return co_moving ? BaseState{0, 0} : lab_base_at(step); }

  /// Acceleration of a free grain at a step. In the co-moving frame the fictitious part is the
  /// second difference of z_b over steps, -(2/dt)^2 sin^2(omega dt/2) z_b, so that leapfrog
  /// positions agree with the lab's to rounding.
  double field_at(long step) const {
    if (!co_moving) return -gravity;
    const double turn = std::numbers::pi / static_cast<double>(steps_per_cycle);
    const double rate = 2 * std::sin(turn) / time_step;
    return -gravity + rate * rate * lab_base_at(step).height;
  }

  /// No free grain's velocity against the container changes faster.
  double largest_field() const { return gravity + base.largest_acceleration(); }

  /// Force of the drag on a grain of velocity v in the frame of the simulation.
  Triple<double> drag_force(const Triple<double>& v, double container_velocity) const {
    const double in_lab = co_moving ? container_velocity : 0;
    const double in_container = co_moving ? 0 : container_velocity;
    return {-drag.lateral_rate() * v.x, -drag.lateral_rate() * v.y,
            -drag.background * (v.z + in_lab) - drag.vertical_air_rate() * (v.z - in_container)};
  }
};

}  // namespace shakebed::simulator
