#pragma once

#include <vector>

#include "simulator/boundary/base.hpp"
#include "simulator/dimension.hpp"
#include "simulator/grains/grains.hpp"
#include "simulator/record.hpp"

namespace shakebed::simulator {

/// Part of a unit sphere's volume (D = 3: (pi/6) d^3) or disc's area (D = 2: (pi/4) d^2), centred
/// at height 0, that lies below height s in [-1/2, 1/2] (diameters): the cap formulas.
template <int D>
double part_below(double s);

/// Profiles over height, in boxes of depth d fixed in the lab frame: number of centres, first and
/// second moments of each velocity component, and the packing (volume or area) fraction by
/// sphere-slab intersection. Sums are kept in at most 32 blocks of equal duration, merged in pairs
/// when full, so that memory is bounded and errors come from blocks long compared with the
/// correlation time.
///
/// The local temperature T_c of a box is m/2 times the variance of its grains' v_c, with the mean
///   time:     over all its grains at all times, so that T_c = m(<v_c^2> - <v_c>^2)/2;
///   phase:    over its grains at one phase of the cycle, in all cycles: motion that the drive
///             repeats is taken out, T_c = m(<v_c^2> - <<v_c>_phase^2>)/2;
///   instant:  over its grains at each instant; the variances of all instants are averaged, and a
///             box with fewer than two grains counts as cold.
/// The last is what a program gets that computes a temperature box by box and averages it in
/// time. It is lower, by (n - 1)/n with n grains in the box, and vanishes where the bed is dilute.
template <int D>
class HeightProfile {
 public:
  enum class LocalMean { time, phase, instant };
  static constexpr std::size_t phases = 16;  ///< of a cycle, that are told apart
  HeightProfile(double lowest, double area, LocalMean local_mean = LocalMean::time);

  /// Heights and velocities are taken relative to `origin` (the base, or the lab by default);
  /// `phase` counts from 0 within a cycle.
  template <class GrainState>
  void sample(const GrainState& grains, const BaseState& origin = {0, 0}, std::size_t phase = 0) {
    sample(grains.position[Dimension<D>::vertical], grains.velocity, origin, phase);
  }

  void end_cycle();

  struct Summary {
    Profile profile;
    double averaging_height;                   ///< below which 99 % of centres lie [d], from z = 0
    std::vector<Estimate> volume_temperature;  ///< T_c averaged over that volume, D of them, and T
    Estimate packing_fraction;                 ///< of all grains in that volume
  };
  /// Errors by the jackknife over blocks (NaN with fewer than four).
  Summary summarise() const;

 private:
  // Of each box: count, (v, v^2) per component, volume; then count and v per component by phase.
  static constexpr std::size_t volume = 1 + 2 * D;
  static constexpr std::size_t first_of_phases = 2 + 2 * D;
  static constexpr std::size_t most_blocks = 32;
  using Sums = std::vector<double>;

  void sample(const std::vector<double>& z, const Columns<D>& velocity, const BaseState& origin,
              std::size_t phase);
  void add_to_phase(const std::vector<double>& z, const Columns<D>& velocity,
                    const BaseState& origin, std::size_t phase);
  void grow(std::size_t boxes);
  void fold_instant();
  double height_below_which(const Sums& sums, double fraction) const;
  double local_temperature(const Sums& sums, double samples, std::size_t box, int component) const;
  std::vector<double> volume_averages(const Sums& sums, double height, double samples) const;

  double lowest_;
  double area_;
  LocalMean local_mean_;
  std::size_t stride_;
  std::size_t boxes_ = 0;
  Sums instant_;  ///< of one sample; `instant` alone
  Sums current_;  ///< of one block; `instant`: variances stand in place of v^2
  long samples_ = 0;
  long cycles_in_current_ = 0;
  long cycles_per_block_ = 1;
  std::vector<Sums> blocks_;
  std::vector<long> block_samples_;
};

}  // namespace shakebed::simulator
