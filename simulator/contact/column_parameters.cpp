#include "simulator/contact/column_parameters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/grains/sized_grains.hpp"

namespace shakebed::simulator {
namespace {

ColumnContactKind kind_of(const std::string& name, const SpringKind& spring, double m_eff) {
  return {name, spring, m_eff, spring.contact_duration(m_eff), spring.restitution(m_eff)};
}

}  // namespace

ColumnParameters bind_column(const Scene& scene) {
  const ColumnScene& column = *scene.column;
  // The lightest small grain has the shortest contacts.
  const double small = sphere_mass(column.smallest, 1);
  ColumnParameters p{};
  p.kinds = {kind_of("small-small", column.grain, 0.5 * small),
             kind_of("small-wall", column.wall, small)};
  if (column.has_large) {
    const double large = sphere_mass(column.large_diameter, column.large_density);
    p.kinds.push_back(kind_of("small-large", column.grain, small * large / (small + large)));
    p.kinds.push_back(kind_of("large-wall", column.wall, large));
  }
  p.contact_duration = p.kinds.front().contact_duration;
  for (const auto& kind : p.kinds) {
    p.contact_duration = std::min(
        {p.contact_duration, kind.contact_duration, std::numbers::pi / kind.spring.normal_rate});
  }
  const double period = scene.base.drive.period();
  const double wanted =
      column.time_step.value_or(scene.protocol.time_step_fraction * p.contact_duration);
  const double strides = period / (wanted * column_phases);
  const double whole = column.time_step ? std::round(strides) : std::ceil(strides);
  p.steps_per_cycle = column_phases * std::max(1L, std::lround(whole));
  p.time_step = period / static_cast<double>(p.steps_per_cycle);
  return p;
}

}  // namespace shakebed::simulator
