#pragma once

#include "simulator/motion/grain_motion.hpp"
#include "simulator/motion/grid_row.hpp"

namespace shakebed::simulator {

/// A contact that nobody disturbs, stepped on the global time grid: the numbers that FineContacts
/// gives, to rounding, from the relative motion alone. Two grains in contact have a centre that
/// falls freely; one on the base has none.
template <class Physics>
class SteppedContact {
 public:
  static constexpr int D = Physics::dimension;
  static constexpr int S = Physics::GrainState::spin_columns;
  using Motion = GrainMotion<Physics>;
  using Row = GridRow<Physics>;

  /// Two grains that fly until `step`, the last before their touch; the nearest images touch.
  SteppedContact(const Physics& physics, const Motion& i, const Motion& j, long step)
      : physics_(physics), partners_(2), first_step_(step), step_(step), i_(i), j_(j) {
    Vector<D> r = j.x - i.x;
    for (int c = 0; c < Dimension<D>::lateral; ++c) r[c] += physics.cell.image_shift(c, r[c]);
    now_.r = r;
    now_.half = i.v - j.v;
    if constexpr (S > 0) now_.spin_half = grain_radius * (i.spin + j.spin);
    spin_at_start_ = now_.spin_half;
    centre_ = i.x + 0.5 * r;
    unwrap_ = j.x - i.x - r;
  }
  /// A grain that flies until `step`, the last before it touches the base.
  SteppedContact(const Physics& physics, const Motion& i, long step)
      : physics_(physics), partners_(1), first_step_(step), step_(step), i_(i), j_{} {
    now_.r = -i.x;
    now_.half = i.v;
    now_.half[vertical] += 0.5 * physics.time_step * physics.gravity;
    now_.change[vertical] = -physics.gravity;
    if constexpr (S > 0) now_.spin_half = grain_radius * i.spin;
    spin_at_start_ = now_.spin_half;
  }

  /// Steps until the partners are apart again; false if they never touched (they graze) or would
  /// not part within `most_steps`.
  bool run_until_apart(long most_steps) {
    partners_ == 2 ? run<2>(step_ + most_steps, true) : run<1>(step_ + most_steps, true);
    return ledger_.contact_steps > 0 && !touching_;
  }
  void run_to(long step) { partners_ == 2 ? run<2>(step, false) : run<1>(step, false); }

  long step() const { return step_; }
  bool touching() const { return touching_; }
  const EnergyLedger& ledger() const { return ledger_; }  ///< of this contact since it began
  /// From i to the image of j it touches.
  Vector<D> apart() const { return now_.r; }

  Motion motion_i() const { return motion_of(i_, 1); }
  Motion motion_j() const { return motion_of(j_, -1); }
  Row row_i() const { return row_of(i_, 1); }
  Row row_j() const { return row_of(j_, -1); }

  double elastic_energy() const {
    if (!touching_) return 0;
    return partners_ == 2 ? physics_.grain_grain.normal.stored_energy(1 - now_.r.norm())
                          : physics_.grain_base.normal.stored_energy(height_of(base(step_)));
  }

 private:
  static constexpr int vertical = Dimension<D>::vertical;

  /// Of i relative to its partner, in leapfrog form; against the base r is minus i's position.
  template <class Number>
  struct Relative {
    using Linear = Vector<D, Number>;
    using Angular = Spin<D, Number>;
    Linear r = constant<Linear>(0);
    Linear half = constant<Linear>(0);         ///< v_i - v_j half a step ago
    Linear change = constant<Linear>(0);       ///< its rate
    Angular spin_half = constant<Angular>(0);  ///< the sum of omega R
    Angular spin_change = constant<Angular>(0);
  };

  BaseState base(long step) const { return physics_.base_at_step(step % physics_.steps_per_cycle); }
  double height_of(const BaseState& base) const {
    return base.height + grain_radius + now_.r[vertical];
  }

  template <int Partners>
  void run(long last, bool until_apart) {
    constexpr long latest_touch = 2;  // rounding may put off by one step what was to be the first
    constexpr double spin_share = Partners * grain_radius * grain_radius / grain_inertia;
    const Lane dt = physics_.time_step;
    const Lane h = 0.5 * physics_.time_step;
    const auto& law = Partners == 2 ? physics_.grain_grain : physics_.grain_base;
    Relative<Lane> m = spread(now_);
    Lane dissipation = 0;
    EnergyLedger ledger = ledger_;
    bool touching = touching_;
    while (step_ < last) {
      ++step_;
      m.half += dt * m.change;
      m.r -= dt * m.half;
      Vector<D, Lane> v = m.half + h * m.change;
      const Spin<D, Lane> spin = m.spin_half + (dt + h) * m.spin_change;
      m.spin_half += dt * m.spin_change;
      m.change = constant<Vector<D, Lane>>(0);
      m.spin_change = constant<Spin<D, Lane>>(0);
      Vector<D, Lane> n = constant<Vector<D, Lane>>(0);
      Lane overlap, per_distance;
      BaseState below{};
      if constexpr (Partners == 2) {
        const Lane rr = m.r.squaredNorm();
        const Lane distance = std::experimental::sqrt(rr);
        overlap = 2 * grain_radius - distance;
        per_distance = distance * (1 / rr);  // sooner there than after the root
        n = m.r * per_distance;
      } else {
        below = base(step_);
        overlap = below.height + grain_radius + m.r[vertical];
        n[vertical] = -1;
        v[vertical] -= below.velocity;
        m.change[vertical] = -physics_.gravity;
      }
      if (overlap[0] <= 0) {
        const bool ends = until_apart && (touching || step_ - first_step_ >= latest_touch);
        touching = false;
        if (ends) break;
        continue;
      }
      Lane closing_speed;
      if constexpr (Partners == 2) {
        closing_speed = v.dot(m.r) * per_distance;
      } else {
        closing_speed = -v[vertical];
      }
      const auto f = law.template operator()<Lane>(n, overlap, v, spin, closing_speed);
      m.change += Lane(Partners) * f.force;
      m.spin_change = Lane(spin_share) * f.moment_per_radius;
      ledger.count_step(overlap[0], !touching);
      dissipation += f.dissipated_power;
      if constexpr (Partners == 1) {
        ledger.base_work += Lane(f.force[vertical])[0] * below.velocity * physics_.time_step;
      }
      touching = true;
    }
    ledger.dissipation += dissipation[0] * physics_.time_step;
    now_ = gathered(m);
    ledger_ = ledger;
    touching_ = touching;
  }

  template <class V>
  static V constant(double value) {
    return V::Constant(typename V::Scalar(value));
  }
  template <class To, class From>
  static Relative<To> converted(const Relative<From>& m, auto number) {
    Relative<To> result;
    for (int c = 0; c < D; ++c) {
      result.r[c] = number(m.r[c]);
      result.half[c] = number(m.half[c]);
      result.change[c] = number(m.change[c]);
    }
    for (int c = 0; c < m.spin_half.size(); ++c) {
      result.spin_half[c] = number(m.spin_half[c]);
      result.spin_change[c] = number(m.spin_change[c]);
    }
    return result;
  }
  static Relative<Lane> spread(const Relative<double>& m) {
    return converted<Lane>(m, [](double x) { return Lane(x); });
  }
  static Relative<double> gathered(const Relative<Lane>& m) {
    return converted<double>(m, [](const Lane& x) { return double(x[0]); });
  }

  double elapsed() const { return static_cast<double>(step_ - first_step_) * physics_.time_step; }

  Motion motion_of(const Motion& before, double sign) const {
    const double h = 0.5 * physics_.time_step;
    Motion now = motion_lagging(before, sign, h);
    now.x = position_of(sign);
    return now;
  }

  /// Velocity and spin `later` after those half a step ago.
  Motion motion_lagging(const Motion& before, double sign, double later) const {
    Motion m = before;
    const Vector<D> v = now_.half + later * now_.change;
    if (partners_ == 2) {
      m.v = 0.5 * (i_.v + j_.v + sign * v);
      m.v[vertical] -= physics_.gravity * (elapsed() - 0.5 * physics_.time_step + later);
    } else {
      m.v = v;
    }
    if constexpr (S > 0) {
      const Spin<D> spin = now_.spin_half + later * now_.spin_change;
      m.spin += (spin - spin_at_start_) / (partners_ * grain_radius);
    }
    return m;
  }

  Vector<D> position_of(double sign) const {
    if (partners_ == 1) return -now_.r;
    const double t = elapsed();
    Vector<D> x = centre_ + 0.5 * t * (i_.v + j_.v) - 0.5 * sign * now_.r;
    x[vertical] -= 0.5 * physics_.gravity * t * t;
    if (sign < 0) x += unwrap_;
    return x;
  }

  /// The partner as a row of the grid, in the middle of the contact.
  Row row_of(const Motion& before, double sign) const {
    const Motion half = motion_lagging(before, sign, 0);
    const Vector<D> x = position_of(sign);
    Row row;
    for (int c = 0; c < D; ++c) {
      row.x[c] = x[c];
      row.half[c] = half.v[c];
      row.change[c] = partners_ == 2 ? 0.5 * sign * now_.change[c] : now_.change[c];
    }
    if (partners_ == 2) row.change[vertical] -= physics_.gravity;
    for (int c = 0; c < S; ++c) {
      row.half[GridRow<Physics>::spin_first + c] = half.spin[c];
      row.change[GridRow<Physics>::spin_first + c] =
          now_.spin_change[c] / (partners_ * grain_radius);
    }
    return row;
  }

  const Physics& physics_;
  int partners_;  ///< 1: the base is the other
  long first_step_;
  long step_;
  Motion i_;  ///< as they began
  Motion j_;
  Vector<D> centre_ = Vector<D>::Zero();
  Vector<D> unwrap_ = Vector<D>::Zero();  ///< from the image of j that is touched to j
  Spin<D> spin_at_start_;
  Relative<double> now_;
  bool touching_ = false;
  EnergyLedger ledger_;
};

}  // namespace shakebed::simulator
