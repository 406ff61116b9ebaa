#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "simulator/motion/column/contact_list.hpp"
#include "simulator/motion/column/physics.hpp"
#include "simulator/record.hpp"

namespace shakebed::simulator {

/// What a bed in a container is like at equal phases of every cycle, from the instant the base
/// begins to move: entry k belongs to (k/column_phases) cycles. Heights are in the laboratory, over
/// the base's mean height.
class ColumnSeries {
 public:
  enum Column : std::size_t {
    large_height,        ///< centre of the large grain [d]; NaN when there is none
    large_velocity,      ///< [sqrt(g d)]
    small_height,        ///< centre of mass of the small grains [d]
    small_velocity,      ///< [sqrt(g d)]
    base_height,         ///< [d]
    coordination,        ///< 2 contacts/grains, walls not counted
    coordination_walls,  ///< (2 contacts + wall contacts)/grains
    base_force,          ///< of the bed on the base, downwards [m g]
    side_force,          ///< of the bed on the side wall, downwards [m g]
    side_normal_force,   ///< sum of what grains press against the side wall [m g]
    columns
  };

  struct Counts {
    long pairs;
    long walls;
  };

  void sample(const SizedGrains& grains, bool has_large, const Counts& touching,
              const WallForces& walls, const BaseState& lab_base, bool co_moving) {
    const double up = co_moving ? lab_base.height : 0;
    const double faster = co_moving ? lab_base.velocity : 0;
    double mass = 0;
    double height = 0;
    double velocity = 0;
    for (std::size_t i = has_large ? 1 : 0; i < grains.count(); ++i) {
      mass += grains.mass[i];
      height += grains.mass[i] * grains.position[2][i];
      velocity += grains.mass[i] * grains.velocity[2][i];
    }
    const auto n = static_cast<double>(grains.count());
    const double none = std::nan("");
    push(large_height, has_large ? grains.position[2][0] + up : none);
    push(large_velocity, has_large ? grains.velocity[2][0] + faster : none);
    push(small_height, height / mass + up);
    push(small_velocity, velocity / mass + faster);
    push(base_height, lab_base.height);
    push(coordination, 2 * static_cast<double>(touching.pairs) / n);
    push(coordination_walls, static_cast<double>(2 * touching.pairs + touching.walls) / n);
    push(base_force, -walls.base_vertical);
    push(side_force, -walls.side_vertical);
    push(side_normal_force, walls.side_normal);
  }

  const std::vector<double>& operator[](Column column) const { return values_[column]; }
  std::size_t size() const { return values_[0].size(); }

  static const char* name(Column column) {
    constexpr const char* names[] = {"large_height",
                                     "large_velocity",
                                     "small_height",
                                     "small_velocity",
                                     "base_height",
                                     "coordination",
                                     "coordination_with_walls",
                                     "base_force",
                                     "side_force",
                                     "side_normal_force"};
    return names[column];
  }
  static const char* unit(Column column) {
    constexpr const char* units[] = {"d", "sqrt(g d)", "d",   "sqrt(g d)", "d",
                                     "1", "1",         "m g", "m g",       "m g"};
    return units[column];
  }

  template <class Archive>
  void archive(Archive& a) {
    for (auto& column : values_) a(column);
  }

 private:
  void push(Column column, double value) { values_[column].push_back(value); }

  std::array<std::vector<double>, columns> values_;
};

/// The cycle at which the large grain has come to the surface for good, or NaN. The surface lies as
/// high above the small grains' centre of mass as that lies above the base at T = 0, in the packed
/// bed at rest; the grain is there when its top, averaged over a cycle, reaches it, and stays when
/// it never falls by more than its radius below it again. Both heights fly with the bed, so that a
/// bed high above the base is no taller for it. Between cycles, which count from their middle,
/// straight lines. (The paper states no rule for its rise times.)
double rise_time(const ColumnSeries& series, long phases, double large_radius);

/// Everything of the series that goes into a run's record.
void write_column_series(Record& record, const ColumnSeries& series, long phases,
                         double large_radius, bool has_large);

}  // namespace shakebed::simulator
