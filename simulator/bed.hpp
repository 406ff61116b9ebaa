#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "files/error.hpp"
#include "simulator/contact/parameters.hpp"
#include "simulator/grains/filling.hpp"
#include "simulator/motion/uniform.hpp"
#include "simulator/observables/measurement.hpp"
#include "simulator/observables/snapshot.hpp"
#include "simulator/simulate.hpp"

namespace shakebed::simulator {

/// A way to move a bed's grains on the global time grid. Starts at step 0 of a cycle.
template <class M, class GrainState>
concept Mover = requires(M mover, long steps) {
  mover.advance(steps);
  { mover.synchronised() } -> std::convertible_to<const GrainState&>;
  { mover.ledger() } -> std::convertible_to<EnergyLedger&>;
  { mover.energy() } -> std::same_as<double>;
};

inline double thread_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Physics>
struct SettledBed {
  typename Physics::GrainState grains;
  double rest_height;  ///< mean height of centres over the still base [d]
};

/// Cell, laws, base and time step of a bed.
template <class Bed>
Bed bind_bed(const Scene& scene, const Parameters& p) {
  PeriodicCell<Bed::dimension> cell{};
  std::copy(scene.cell.begin(), scene.cell.end(), cell.width.begin());
  using Law = typename Bed::ContactLaw;
  return Bed{cell,
             Law(p.grain_grain),
             Law(p.grain_base),
             {scene.base.drive.amplitude, scene.base.drive.peak_velocity()},
             scene.gravity,
             p.time_step,
             p.steps_per_cycle};
}

template <int D>
int drive_axis(const Scene& scene) {
  return scene.base.direction == DriveDirection::x ? 0 : Dimension<D>::vertical;
}

/// Base, lid and side walls as planes. Between side walls the cell is widened, so that no grain
/// finds another's image within reach (at most 2 d).
template <class Physics>
Physics bind_walls(const Scene& scene, const Parameters& p) {
  using Law = typename Physics::ContactLaw;
  constexpr int vertical = Dimension<Physics::dimension>::vertical;
  const int axis = drive_axis<Physics::dimension>(scene);
  auto bed = bind_bed<typename Physics::Base>(scene, p);
  std::vector<typename Physics::Wall> walls{{vertical, 1, 0, true, axis, Law(p.grain_base)}};
  if (scene.lid) {
    walls.push_back(
        {vertical, -1, scene.lid->height, scene.lid->moves_with_base, axis, Law(p.grain_lid)});
  }
  if (scene.side_walls) {
    walls.push_back({0, 1, 0, true, axis, Law(p.grain_side_wall)});
    walls.push_back({0, -1, scene.cell[0], true, axis, Law(p.grain_side_wall)});
    bed.cell.width[0] += 3;
  }
  return {bed, std::move(walls), !scene.side_walls};
}

template <class Physics>
Physics bind_physics(const Scene& scene, const Parameters& p) {
  if constexpr (Physics::walled) {
    return bind_walls<Physics>(scene, p);
  } else {
    return bind_bed<Physics>(scene, p);
  }
}

/// Grains poured into the scene's cell; without gravity, spread between base and lid and given
/// Gaussian velocities of standard deviation V_p/2, so that a run rescaled in V_p stays the same.
template <class Physics>
typename Physics::GrainState poured(const Scene& scene) {
  constexpr int D = Physics::dimension;
  PeriodicCell<D> cell{};
  std::copy(scene.cell.begin(), scene.cell.end(), cell.width.begin());
  const auto count = static_cast<std::size_t>(scene.grains.count);
  double spacing = usual_layer_spacing;
  if (scene.lid) {
    const auto layers = static_cast<double>(filled_layers(count, scene.cell));
    const double room = (scene.clearance() - 0.1) / layers;
    spacing = scene.gravity > 0 ? std::min(spacing, room) : room;
  }
  auto grains = fill<D, Physics::turns_grains>(count, cell, scene.seed, spacing);
  if (scene.gravity == 0) {
    RandomStream random(scene.seed, RandomPurpose::thermal_velocities);
    for (auto& column : grains.velocity) {
      for (double& v : column) v = 0.5 * scene.base.drive.peak_velocity() * random.normal();
    }
  }
  return grains;
}

/// Pours the grains on the still base and lets them come to rest: with the scene's restitution and
/// friction, soft springs (k_n = 5e3 max(1, N/4) m g/d, static overlaps near 1e-3 d), and
/// velocities damped at the rate 1/2 sqrt(g/d), which only hastens what collisions do. Without
/// tangential springs a rough bed creeps for long: after 60 sqrt(d/g) it is taken as it is.
/// The bed that leaves here moves with the base, which starts at full speed: no first blow.
/// Without gravity there is nothing to wait for, and no rest height (NaN).
template <class Physics>
SettledBed<Physics> settle(const Scene& scene, const RunControl& control) {
  if (scene.gravity == 0) return {poured<Physics>(scene), std::nan("")};
  Scene still = scene;
  const double static_stiffness =
      5e3 * std::max(1.0, scene.grains.layers / 4) * std::max(scene.gravity, 1e-300);
  still.contact.stiffness = std::min(bind_parameters(scene).stiffness, static_stiffness);
  still.base.drive = {0, 2 * std::numbers::pi};
  still.protocol.time_step_fraction = 0.06;
  const auto physics = bind_physics<Physics>(still, bind_parameters(still));

  UniformStepper<Physics> mover(physics, poured<Physics>(scene));
  const double longest = scene.protocol.settle.value_or(60);
  constexpr double interval = 0.25;
  const auto steps = std::lround(interval / physics.time_step);
  const auto n = static_cast<double>(scene.grains.count);
  constexpr double rest_energy = 1e-7;  // kinetic energy per grain [m g d]
  bool at_rest = false;
  for (double t = 0; t < longest && !at_rest; t += interval) {
    if (control.stop_requested && control.stop_requested()) throw files::Interrupted();
    mover.advance(steps);
    mover.damp(std::exp(-0.5 * interval));
    at_rest = !scene.protocol.settle && t > 5 && mover.kinetic_energy() < rest_energy * n;
  }
  SettledBed<Physics> bed{mover.synchronised(), 0};
  constexpr int vertical = Dimension<Physics::dimension>::vertical;
  const int along = drive_axis<Physics::dimension>(scene);
  for (int c = 0; c <= vertical; ++c) {
    auto& column = bed.grains.velocity[c];
    std::fill(column.begin(), column.end(), c == along ? scene.base.drive.peak_velocity() : 0.0);
  }
  for (auto& column : bed.grains.spin) std::fill(column.begin(), column.end(), 0.0);
  for (const double z : bed.grains.position[vertical]) {
    bed.rest_height += z / n;
  }
  return bed;
}

/// Discards the transient and measures on a mover.
template <class MoverType, int D>
class Protocol {
 public:
  Protocol(const Scene& scene, const Parameters& parameters, MoverType& mover,
           const RunControl& control)
      : scene_(scene), parameters_(parameters), mover_(mover), control_(control) {}

  /// What takes a snapshot: given the step in the cycle that the mover stands at, and the whole
  /// cycles since the base began to move.
  using SnapshotTaker = std::function<Snapshot(long step_in_cycle, long cycle)>;
  void take_snapshots_with(SnapshotTaker taker) { take_snapshot_ = std::move(taker); }
  std::vector<Snapshot>& snapshots() { return snapshots_; }

  /// Discards fewer cycles than planned when Gamma < 1 and a whole cycle was quiet.
  void discard() {
    const long planned = scene_.protocol.transient.value_or(automatic_transient(scene_));
    for (long c = 0; c < planned; ++c) {
      poll(0.5 * static_cast<double>(c) / static_cast<double>(planned));
      ++discarded_;
      if (!scene_.never_thrown()) {
        mover_.advance(parameters_.steps_per_cycle);
        continue;
      }
      Measurement<D> look(scene_, 0);
      measure_cycle(look);
      if (look.at_rest()) return;
    }
  }

  /// Measures for the cycles asked for, or until the quantity asked for is known. In the latter
  /// case a bed found drifting at a look (a plug that melts late, say) has all that was measured
  /// discarded when its transient is ours to choose. Call open_books() first.
  void measure(Measurement<D>& measurement) {
    const auto& rule = scene_.protocol;
    const long most = rule.cycles.value_or(rule.at_most);
    long next_look = first_look();
    int restarts = rule.until && !rule.transient ? most_restarts : 0;
    constexpr long looks_before_one_knows = 3;
    long expected = rule.until ? std::min(most, next_look << looks_before_one_knows) : most;
    while (measurement.cycles() < most) {
      poll(0.5 + 0.5 * static_cast<double>(measurement.cycles()) / static_cast<double>(expected));
      measure_cycle(measurement, measurement.cycles() < rule.snapshots.cycles);
      if (over_early(measurement)) break;
      if (!rule.until || measurement.cycles() < next_look) continue;
      if (measurement.at_rest()) break;
      if (restarts > 0 && measurement.drifts()) {
        --restarts;
        discarded_ += measurement.cycles();
        measurement.restart();
        snapshots_.clear();
        open_books();
        next_look = first_look();
        continue;
      }
      if (measurement.precise_enough(*rule.until)) break;
      const double needed = 1.1 * measurement.cycles_needed(*rule.until);
      next_look = look_after(next_look, needed);
      expected =
          std::max(next_look, needed < static_cast<double>(most) ? std::lround(needed) : most);
      expected = std::min(expected, most);
    }
  }

  /// Starts the ledger anew.
  void open_books() {
    mover_.ledger() = {};
    energy_before_ = mover_.energy();
  }
  double energy_change() const { return mover_.energy() - energy_before_; }
  long discarded() const { return discarded_; }

 private:
  static constexpr int most_restarts = 8;

  /// Not before 32 cycles, nor before eight flights 2 V_p/g of the bed.
  long first_look() const {
    const double flights = 8 * scene_.flight_time() / scene_.base.drive.period();
    return std::max(32L, static_cast<long>(std::ceil(flights)));
  }

  /// Where the error is expected to do, within sqrt(2) to 2 times the cycles of the look before:
  /// looking at every cycle and stopping at a lucky one would undercover. Against doublings this
  /// saves a fifth of the cycles; tests/simulator/protocol_test.cpp holds the coverage.
  static long look_after(long look, double needed) {
    const auto now = static_cast<double>(look);
    return std::lround(std::ceil(std::clamp(needed, std::numbers::sqrt2 * now, 2 * now)));
  }

  void poll(double fraction) const {
    if (control_.stop_requested && control_.stop_requested()) throw files::Interrupted();
    if (control_.on_progress) control_.on_progress(fraction);
  }

  void measure_cycle(Measurement<D>& measurement, bool with_snapshots = false) {
    const long stride = parameters_.steps_per_cycle / phases_per_cycle;
    long done = 0;
    for (long next = stride; next <= parameters_.steps_per_cycle; next += stride) {
      if (with_snapshots && take_snapshot_)
        done = take_snapshots(done, next, discarded_ + measurement.cycles());
      mover_.advance(next - done);
      done = next;
      sample(measurement);
    }
    measurement.end_cycle(mover_.ledger());
  }

  /// A mover that keeps the sums itself is asked for its grains only where profiles need them.
  void sample(Measurement<D>& measurement) {
    if constexpr (requires { mover_.moments(); }) {
      measurement.sample(mover_.moments());
      if (measurement.profile_is_due()) measurement.sample_profile(mover_.synchronised());
    } else {
      const auto& grains = mover_.synchronised();
      measurement.sample(moments_of(grains));
      if (measurement.profile_is_due()) measurement.sample_profile(grains);
    }
  }

  /// Those in [from, to) of the cycle's steps; returns the step at which the mover stands then.
  long take_snapshots(long from, long to, long cycle) {
    for (const double phase : scene_.protocol.snapshots.phases) {
      const long step = std::lround(phase * static_cast<double>(parameters_.steps_per_cycle)) %
                        parameters_.steps_per_cycle;
      if (step < from || step >= to) continue;
      if (step > from) mover_.advance(step - from);
      from = step;
      snapshots_.push_back(take_snapshot_(step, cycle));
      snapshots_.back().name = snapshot_name(static_cast<double>(cycle) + phase);
    }
    return from;
  }

  /// With Gamma < 1 the base cannot throw a bed that rests on it: four quiet cycles decide.
  bool over_early(const Measurement<D>& measurement) const {
    return scene_.never_thrown() && measurement.cycles() >= 4 && measurement.at_rest();
  }

  const Scene& scene_;
  const Parameters& parameters_;
  MoverType& mover_;
  const RunControl& control_;
  long discarded_ = 0;
  double energy_before_ = 0;
  SnapshotTaker take_snapshot_;
  std::vector<Snapshot> snapshots_;
};

}  // namespace shakebed::simulator
