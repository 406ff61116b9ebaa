#include "simulator/contact/sliding_table.hpp"

#include <algorithm>
#include <cmath>

namespace shakebed::simulator {
namespace {

constexpr double slip_per_impulse = 3.5;  // 1 + 5/2, solid spheres
constexpr std::size_t time_steps = 1024;

/// Caps mu |F_n|/(m_eff v) at the ends and middles of the time steps.
std::vector<double> friction_caps(const ContactKind& kind, const ClosedNormal& normal) {
  std::vector<double> caps(2 * time_steps + 1);
  for (std::size_t k = 0; k < caps.size(); ++k) {
    const double t = normal.duration() * static_cast<double>(k) / (2.0 * time_steps);
    caps[k] = kind.friction * std::abs(normal.force(t));
  }
  return caps;
}

}  // namespace

SlidingTable::SlidingTable(const ContactKind& kind, const ClosedNormal& normal) {
  const auto caps = friction_caps(kind, normal);
  const double dt = normal.duration() / time_steps;
  const double rate = kind.tangential_damping / kind.effective_mass;

  // Slides throughout when the dashpot asks for more than the cap at all times.
  double slid = 0;
  double q_sliding = 0;
  for (std::size_t k = 0; k < time_steps; ++k) {
    if (rate > 0) q_sliding = std::max(q_sliding, slid + caps[2 * k] / rate);
    slid += slip_per_impulse * dt / 6 * (caps[2 * k] + 4 * caps[2 * k + 1] + caps[2 * k + 2]);
  }
  const double q_last = rate > 0 ? std::max(q_sliding, slid + caps.back() / rate) : 1;
  step_ = std::max(q_last, 1e-12) / (entries - 1);

  const auto decay = [&](double sigma, double cap) {
    return -slip_per_impulse * std::min(rate * sigma, cap);
  };
  for (std::size_t e = 0; e < entries; ++e) {
    const double q = step_ * static_cast<double>(e);
    double sigma = q;
    double displacement = 0;
    for (std::size_t k = 0; k < time_steps; ++k) {  // Runge-Kutta of fourth order
      const double k1 = decay(sigma, caps[2 * k]);
      const double k2 = decay(sigma + 0.5 * dt * k1, caps[2 * k + 1]);
      const double k3 = decay(sigma + 0.5 * dt * k2, caps[2 * k + 1]);
      const double k4 = decay(sigma + dt * k3, caps[2 * k + 2]);
      const double next = sigma + dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      displacement += dt * (q - 0.5 * (sigma + next));
      sigma = next;
    }
    q_.push_back(q);
    impulse_.push_back((q - sigma) / slip_per_impulse);
    displacement_.push_back(displacement);
  }
  last_ = {impulse_.back(), displacement_.back()};
}

}  // namespace shakebed::simulator
