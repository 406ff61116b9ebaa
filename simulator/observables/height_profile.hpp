#pragma once

#include <vector>

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
template <int D>
class HeightProfile {
 public:
  HeightProfile(double lowest, double area);

  template <class GrainState>
  void sample(const GrainState& grains) {
    for (std::size_t i = 0; i < grains.count(); ++i) {
      const double above = grains.position[Dimension<D>::vertical][i] - lowest_;
      const auto box = static_cast<std::size_t>(above > 0 ? above : 0);
      if (box + 2 > boxes_) grow(box + 2);
      double* sums = current_.data() + box * stride;
      sums[0] += 1;
      for (int c = 0; c < D; ++c) {
        const double v = grains.velocity[c][i];
        sums[1 + 2 * c] += v;
        sums[2 + 2 * c] += v * v;
      }
      spread_volume(box, above - static_cast<double>(box) - 0.5);
    }
    ++samples_;
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
  static constexpr std::size_t stride = 2 + 2 * D;  ///< count, (v, v^2) per component, volume
  static constexpr std::size_t most_blocks = 32;
  using Sums = std::vector<double>;

  void grow(std::size_t boxes);
  void spread_volume(std::size_t box, double offset);
  double height_below_which(const Sums& sums, double fraction) const;
  double local_temperature(const Sums& sums, std::size_t box, int component) const;
  std::vector<double> volume_averages(const Sums& sums, double height, double samples) const;

  double lowest_;
  double area_;
  std::size_t boxes_ = 0;
  Sums current_;
  long samples_ = 0;
  long cycles_in_current_ = 0;
  long cycles_per_block_ = 1;
  std::vector<Sums> blocks_;
  std::vector<long> block_samples_;
};

}  // namespace shakebed::simulator
