#pragma once

#include "tests/physics/impact.hpp"

namespace shakebed::tests {

/// The same equations of motion once more, as plainly as they can be written: velocity Verlet with
/// x, v and a at full steps, dashpots taken at the predicted velocity v + a dt, every pair of
/// grains and every grain at the base looked at in every step, the force laws written out from
/// Bhateja 2016, Eqs. A3-A8. Shares no code with the stepper but vectors and parameters.
template <int D>
class PlainIntegrator {
 public:
  PlainIntegrator(const simulator::Scene& scene, const simulator::Parameters& p,
                  const simulator::Grains<D, true>& start)
      : scene_(scene), p_(p), n_(start.count()) {
    for (std::size_t i = 0; i < n_; ++i) {
      x.push_back(row(start.position, i));
      v.push_back(row(start.velocity, i));
      omega.push_back(row(start.spin, i));
    }
    forces(v, omega);
  }

  void step() {
    const double dt = p_.time_step;
    auto v_predicted = v;
    auto omega_predicted = omega;
    const auto a = a_;
    const auto alpha = alpha_;
    for (std::size_t i = 0; i < n_; ++i) {
      x[i] += dt * v[i] + 0.5 * dt * dt * a[i];
      v_predicted[i] += dt * a[i];
      omega_predicted[i] += dt * alpha[i];
    }
    ++steps_;
    forces(v_predicted, omega_predicted);
    for (std::size_t i = 0; i < n_; ++i) {
      v[i] += 0.5 * dt * (a[i] + a_[i]);
      omega[i] += 0.5 * dt * (alpha[i] + alpha_[i]);
    }
  }

  std::vector<Vector<D>> x, v;
  std::vector<Spin<D>> omega;

 private:
  void forces(const std::vector<Vector<D>>& velocity, const std::vector<Spin<D>>& spin) {
    Vector<D> weight = Vector<D>::Zero();
    weight[D - 1] = -scene_.gravity;
    a_.assign(n_, weight);
    alpha_.assign(n_, Spin<D>::Zero());
    const auto& drive = scene_.base.drive;
    const double phase = drive.angular_frequency * static_cast<double>(steps_) * p_.time_step;
    Vector<D> base_velocity = Vector<D>::Zero();
    base_velocity[D - 1] = drive.peak_velocity() * std::cos(phase);
    for (std::size_t i = 0; i < n_; ++i) {
      Vector<D> down = Vector<D>::Zero();
      down[D - 1] = -1;
      const double gap = x[i][D - 1] - 0.5 - drive.amplitude * std::sin(phase);
      if (gap < 0) {
        const Vector<D> F =
            force(p_.grain_base, down, -gap, velocity[i] - base_velocity, Spin<D>(0.5 * spin[i]));
        push(i, down, F);
      }
      for (std::size_t j = i + 1; j < n_; ++j) {
        Vector<D> r = x[j] - x[i];
        for (int c = 0; c < D - 1; ++c) r[c] = std::remainder(r[c], scene_.cell[c]);
        const double distance = r.norm();
        if (distance >= 1) continue;
        const Vector<D> n = r / distance;
        const Vector<D> F = force(p_.grain_grain, n, 1 - distance, velocity[i] - velocity[j],
                                  Spin<D>(0.5 * (spin[i] + spin[j])));
        push(i, n, F);
        push(j, Vector<D>(-n), Vector<D>(-F));
      }
    }
  }

  /// F at the point R n from the centre: a = F/m, alpha = R n x F/I.
  void push(std::size_t i, const Vector<D>& n, const Vector<D>& F) {
    a_[i] += F;
    alpha_[i] += simulator::moment<D>(Vector<D>(0.5 * n), F) / (0.4 * 0.25);
  }

  static Vector<D> force(const simulator::ContactKind& kind, const Vector<D>& n, double overlap,
                         const Vector<D>& v, const Spin<D>& turn) {
    const double closing = v.dot(n);
    const double F_n = kind.stiffness * overlap + kind.normal_damping * closing;
    const Vector<D> slip = v - closing * n + cross<D>(turn, n);
    const double s = slip.norm();
    const double F_t = std::min(kind.tangential_damping * s, kind.friction * std::abs(F_n));
    return -F_n * n - (s > 0 ? F_t / s : 0) * slip;
  }

  simulator::Scene scene_;
  simulator::Parameters p_;
  std::size_t n_;
  long steps_ = 0;
  std::vector<Vector<D>> a_;
  std::vector<Spin<D>> alpha_;
};

}  // namespace shakebed::tests
