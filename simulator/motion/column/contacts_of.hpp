#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/physics.hpp"

namespace shakebed::simulator {

/// One grain as contact laws see it.
struct SeenGrain {
  Triple<double> position;
  Triple<double> velocity;
  Triple<double> rim_velocity;  ///< a omega
  double radius;
  double mass;
};

inline ContactState<double> pair_state(const SeenGrain& i, const SeenGrain& j) {
  const Triple<double> r = i.position - j.position;
  const double distance = std::sqrt(dot(r, r));
  const double size = i.radius + j.radius;
  const double effective_mass = i.mass * j.mass / (i.mass + j.mass);
  return {(1 / distance) * r, size - distance,         size,
          effective_mass,     i.velocity - j.velocity, i.rim_velocity + j.rim_velocity};
}

inline ContactState<double> base_state(const SeenGrain& i, const BaseState& base) {
  Triple<double> v = i.velocity;
  v.z -= base.velocity;
  return {{0, 0, 1},     base.height + i.radius - i.position.z, 2 * i.radius, i.mass, v,
          i.rim_velocity};
}

inline ContactState<double> side_state(const SeenGrain& i, const Cylinder& cylinder,
                                       const BaseState& base) {
  const double rho = std::sqrt(i.position.x * i.position.x + i.position.y * i.position.y);
  Triple<double> v = i.velocity;
  v.z -= base.velocity;
  const double inverse = 1 / std::max(rho, 1e-300);
  return {{-inverse * i.position.x, -inverse * i.position.y, 0},
          cylinder.overlap(rho, i.radius),
          2 * i.radius,
          i.mass,
          v,
          i.rim_velocity};
}

template <class Memory>
Triple<double> memory_of(const Memory& memory) {
  if constexpr (std::is_empty_v<Memory>) {
    return {0, 0, 0};
  } else {
    return memory;
  }
}

/// The contact as it stands, without carrying its memory on.
template <class Law, class Memory>
ColumnContact contact_now(const Law& law, std::int32_t i, std::int32_t j,
                          const ContactState<double>& state, Memory memory) {
  const Triple<double> u = memory_of(memory);
  const auto f = law(state, memory, 0);
  return {i, j, state.overlap, f.normal_force, state.normal, f.tangential_force, u};
}

inline void add_wall_force(WallForces& sums, const ColumnContact& contact) {
  const double up = contact.normal_force * contact.normal.z + contact.tangential_force.z;
  if (contact.j == base_partner) {
    sums.base_vertical -= up;
  } else if (contact.j == side_partner) {
    sums.side_vertical -= up;
    sums.side_normal += contact.normal_force;
  }
}

}  // namespace shakebed::simulator
