#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/boundary/base.hpp"
#include "simulator/boundary/periodic.hpp"
#include "simulator/grains/grains.hpp"
#include "simulator/motion/flight.hpp"

namespace shakebed::simulator {

inline constexpr double never = std::numeric_limits<double>::infinity();

struct NextTouch {
  double time = never;  ///< when the pair touches
  std::uint32_t partner = 0;
  double recheck = never;  ///< look again then, if sooner: nearest images hold until this time
};

/// The first touch of grain i with any other grain in flight, looking from time `from`.
///
/// The separation r(t) = r + u tau of two flights is a straight line: |r + u tau| = 1 at
///   tau = (r.r - 1) / (-r.u + sqrt((r.u)^2 - u.u (r.r - 1))),  if r.u < 0 and the root is real.
/// Only the image nearest at `from` is followed. Another image can touch only after the pair has
/// travelled L - 1 - |dx| across the cell and is level to within a diameter: before the earliest
/// such time over all partners the answer is exact, and that time is returned as `recheck` if it
/// comes before the touch.
template <int D, std::size_t S>
NextTouch next_pair_touch(const Flights<D, S>& flights, const PeriodicCell<D>& cell, std::size_t i,
                          double from) {
  namespace stdx = std::experimental;
  const double start = std::max(from, flights.valid_from[i]);
  NextTouch next;
  double soonest =
      1e30;  // of both answers, finite for products; what comes later matters to nobody
  for (std::size_t j = 0; j < flights.padded(); j += lane_count) {
    const Lanes t = stdx::max(Lanes(start), load_lanes(&flights.valid_from[j]));
    const Lanes ahead = soonest - t;
    Lanes rr = 0, ru = 0, uu = 0, dz = 0, uz = 0;
    std::array<Lanes, Dimension<D>::lateral> room, speed;
    LaneMask image_changes(false);
    for (int c = 0; c < D; ++c) {
      const Lanes u = load_lanes(&flights.velocity[c][j]) - flights.velocity[c][i];
      Lanes r = load_lanes(&flights.position[c][j]) - flights.position[c][i] + u * t;
      if (c < Dimension<D>::lateral) {
        const double width = cell.width[c];
        r -= width * stdx::nearbyint(r * (1 / width));
        room[c] = width - 1 - stdx::fabs(r);
        speed[c] = stdx::fabs(u);
        image_changes = image_changes || room[c] < ahead * speed[c];
      } else {
        dz = r;
        uz = u;
      }
      rr += r * r;
      ru += r * u;
      uu += u * u;
    }
    // Divisions and roots are the dear part, and a product tells whether they could matter.
    const Lanes gap = rr - 1;
    const Lanes discriminant = ru * ru - uu * gap;
    const LaneMask meets = ru < 0 && discriminant > 0 && gap <= -2 * ru * ahead;
    if (stdx::any_of(meets)) {
      Lanes time =
          t + stdx::max(gap / (stdx::sqrt(stdx::max(discriminant, Lanes(0))) - ru), Lanes(0));
      stdx::where(!meets, time) = never;
      const double first = stdx::hmin(time);
      if (first < next.time) {
        next.time = first;
        next.partner = static_cast<std::uint32_t>(j) +
                       static_cast<std::uint32_t>(stdx::find_first_set(time == first));
        soonest = std::min(soonest, first);
      }
    }
    const Lanes height = stdx::fabs(dz) - 1;
    const LaneMask never_level = dz * uz >= 0 && height >= 0;
    if (stdx::any_of(image_changes && height < ahead * stdx::fabs(uz) && !never_level)) {
      Lanes level = height / stdx::fabs(uz);
      stdx::where(never_level, level) = never;
      Lanes image_change = never;
      for (std::size_t c = 0; c < room.size(); ++c) {
        image_change = stdx::min(image_change, room[c] / speed[c]);
      }
      next.recheck = std::min(next.recheck, stdx::hmin(t + stdx::max(image_change, level)));
      soonest = std::min(soonest, next.recheck);
    }
  }
  return next;
}

/// Every grain in flight whose centre is within `reach` of `point` (nearest image) at time t, by
/// the flight's parabola (also before `valid_from`).
template <int D, std::size_t S>
void find_flights_near(const Flights<D, S>& flights, const PeriodicCell<D>& cell,
                       const Vector<D>& point, double t, double reach,
                       std::vector<std::uint32_t>& found) {
  namespace stdx = std::experimental;
  found.clear();
  const double fall = 0.5 * flights.gravity() * t * t;
  std::array<double, Dimension<D>::lateral> per_width;
  for (int c = 0; c < Dimension<D>::lateral; ++c) per_width[c] = 1 / cell.width[c];
  for (std::size_t j = 0; j < flights.padded(); j += lane_count) {
    Lanes rr = 0;
    for (int c = 0; c < D; ++c) {
      Lanes r = load_lanes(&flights.position[c][j]) + load_lanes(&flights.velocity[c][j]) * t;
      r -= c == Dimension<D>::vertical ? point[c] + fall : point[c];
      if (c < Dimension<D>::lateral) r -= cell.width[c] * stdx::nearbyint(r * per_width[c]);
      rr += r * r;
    }
    const LaneMask near = rr < reach * reach;
    if (!stdx::any_of(near)) continue;
    const int last = stdx::find_last_set(near);
    for (int lane = stdx::find_first_set(near); lane <= last; ++lane) {
      if (near[static_cast<std::size_t>(lane)]) {
        found.push_back(static_cast<std::uint32_t>(j) + static_cast<std::uint32_t>(lane));
      }
    }
  }
}

/// The first time in (from, until] at which a grain on the parabola z0 + v0 t - (g/2) t^2 touches
/// the base z_b(t) = A sin(2 pi (phase + t/period)); `never` if there is none.
///
/// f = z - R - z_b has f'' >= -(g + A omega^2), so that f stays positive for
///   tau < (f' + sqrt(f'^2 + 2 f (g + A omega^2))) / (g + A omega^2):
/// steps of that length cannot jump over a root, and converge to it like Newton's method. While the
/// grain is above the base's highest point the bound is g alone and the step is exact.
inline double next_base_touch(double z0, double v0, double gravity, const BaseMotion& base,
                              double phase, double period, double from, double until) {
  const double omega = 2 * 3.14159265358979323846 / period;
  const double bend = gravity + base.peak_velocity * omega;
  double t = from;
  const auto above_at = [&](double time) {
    return z0 + (v0 - 0.5 * gravity * time) * time - grain_radius - base.amplitude;
  };
  const double above = above_at(from);
  if (above > 0) {
    // A parabola is nowhere lower than at both of its ends.
    if (until < never && above_at(until) > 0) return never;
    const double v = v0 - gravity * t;
    if (gravity > 0) {
      t += (v + std::sqrt(v * v + 2 * gravity * above)) / gravity;
    } else {
      if (v >= 0) return never;
      t -= above / v;
    }
  }
  constexpr int most_steps = 200;
  for (int k = 0; k < most_steps && t <= until; ++k) {
    const BaseState b = base.at(phase + t / period);
    const double f = z0 + (v0 - 0.5 * gravity * t) * t - grain_radius - b.height;
    const double rate = v0 - gravity * t - b.velocity;
    if (f <= 1e-14 && rate < 0) return t;
    const double step = (rate + std::sqrt(rate * rate + 2 * bend * std::max(f, 0.0))) / bend;
    if (step < 1e-15 * period) return t;
    t += step;
  }
  return t <= until ? t : never;
}

}  // namespace shakebed::simulator
