#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

#include "simulator/contact/closed_form.hpp"
#include "simulator/contact/contact_kind.hpp"
#include "simulator/contact/sliding_table.hpp"
#include "simulator/dimension.hpp"
#include "simulator/grains/grains.hpp"

namespace shakebed::simulator {

/// A relative motion at a contact: separation r (from i to j, or from a grain's centre to the
/// base), velocity v = v_i - v_j of the centres, and the sum of omega R.
template <int D>
struct RelativeMotion {
  Vector<D> r;
  Vector<D> v;
  Spin<D> spin_radius;
};

/// What an isolated contact does, start to end.
template <int D>
struct ClosedOutcome {
  double duration;
  RelativeMotion<D> start;
  RelativeMotion<D> end;
  Spin<D> spin_radius_change;  ///< of each partner's own omega R
  Vector<D> travel;            ///< tangential travel of i relative to its partner
  double closing_speed;
};

/// Isolated binary contacts in closed form (derived with its limits in docs/engine.md). The normal
/// motion is exact; the tangential outcome comes from a table; during the contact the line of
/// centres turns by the tangential travel, and with it the outcome (`turns`: between grains; the
/// base's normal is fixed). What is neglected is of second order in t_c.
template <int D, bool TurnsGrains>
class ClosedContact {
 public:
  ClosedContact(const ContactKind& kind, bool normal_turns)
      : normal_(kind), normal_turns_(normal_turns) {
    if constexpr (TurnsGrains) sliding_ = std::make_shared<const SlidingTable>(kind, normal_);
  }

  const ClosedNormal& normal() const { return normal_; }

  ClosedOutcome<D> collide(const RelativeMotion<D>& touch) const {
    ClosedOutcome<D> out{normal_.duration(), touch, touch, Spin<D>::Zero(), Vector<D>::Zero(), 0};
    const Vector<D> n = touch.r.normalized();
    out.closing_speed = touch.v.dot(n);
    Vector<D> tangential = touch.v - out.closing_speed * n;
    Vector<D> travel = normal_.duration() * tangential;
    if constexpr (TurnsGrains) {
      const Vector<D> slip = tangential + cross<D>(touch.spin_radius, n);
      const double slip_speed = slip.norm();
      if (slip_speed > 0) {
        const auto outcome = (*sliding_)(slip_speed / out.closing_speed);
        const Vector<D> direction = slip / slip_speed;
        const double change = outcome.impulse * out.closing_speed;
        tangential -= change * direction;
        travel -= (out.closing_speed * outcome.displacement / 3.5) * direction;
        out.spin_radius_change =
            spin_share(effective_mass()) * change * moment<D>(n, Vector<D>(-direction));
      }
    }
    out.travel = travel;
    turn(out, n, tangential);
    return out;
  }

  /// The motion `t` into the contact: normal part exact, tangential impulse in proportion to the
  /// normal one.
  RelativeMotion<D> during(const ClosedOutcome<D>& out, double t) const {
    const double share = std::clamp(t / out.duration, 0.0, 1.0);
    const double impulse = normal_.impulse_fraction(t);
    const Vector<D> n0 = out.start.r.normalized();
    const Vector<D> n1 = out.end.r.normalized();
    const Vector<D> n = (n0 + share * (n1 - n0)).normalized();
    const Vector<D> tangential_start = out.start.v - out.start.v.dot(n0) * n0;
    const Vector<D> tangential_end = out.end.v - out.end.v.dot(n1) * n1;
    Vector<D> tangential = tangential_start + impulse * (tangential_end - tangential_start);
    tangential -= tangential.dot(n) * n;
    RelativeMotion<D> now;
    now.r = (out.start.r.norm() - out.closing_speed * normal_.overlap(t)) * n;
    now.v = out.closing_speed * normal_.closing_speed(t) * n + tangential;
    now.spin_radius =
        out.start.spin_radius + impulse * (out.end.spin_radius - out.start.spin_radius);
    return now;
  }

 private:
  double effective_mass() const { return normal_turns_ ? 0.5 : 1.0; }
  /// Change of one grain's omega R per tangential impulse m_eff x (velocity): R^2 m_eff / I.
  static double spin_share(double mass) {
    return mass * grain_radius * grain_radius / grain_inertia;
  }

  void turn(ClosedOutcome<D>& out, const Vector<D>& n, const Vector<D>& tangential) const {
    const double separation_speed = normal_.restitution() * out.closing_speed;
    const double partners = normal_turns_ ? 2 : 1;
    out.end.spin_radius = out.start.spin_radius + partners * out.spin_radius_change;
    if (!normal_turns_) {
      out.end.v = tangential - separation_speed * n;
      return;
    }
    // r_j - r_i moves by minus the relative travel of i.
    const Vector<D> n1 = (n - out.travel).normalized();
    out.end.r = out.start.r.norm() * n1;
    const Vector<D> middle = n + n1;
    const Vector<D> turned = tangential - (tangential.dot(middle) / (1 + n.dot(n1))) * middle +
                             2 * tangential.dot(n) * n1;
    out.end.v = turned - separation_speed * n1;
  }

  ClosedNormal normal_;
  std::conditional_t<TurnsGrains, std::shared_ptr<const SlidingTable>, char> sliding_{};
  bool normal_turns_;
};

}  // namespace shakebed::simulator
