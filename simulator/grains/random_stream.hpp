#pragma once

#include <Random123/philox.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace shakebed::simulator {

/// Every consumer of random numbers in a bed, by name. Values never change their meaning.
enum class RandomPurpose : std::uint32_t { filling = 1, thermal_velocities = 2 };

/// Counter-based random numbers (Philox 4x32-10, Salmon et al. 2011): the key is the seed and the
/// purpose, so that no consumer disturbs another. The transforms are ours, so that every compiler
/// and library gives the same numbers.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, RandomPurpose purpose)
      : key_{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}},
        purpose_(static_cast<std::uint32_t>(purpose)) {}

  double uniform() {  ///< in (0, 1), 52 bits
    r123::Philox4x32::ctr_type counter{{static_cast<std::uint32_t>(draws_),
                                        static_cast<std::uint32_t>(draws_ >> 32), purpose_, 0}};
    ++draws_;
    const auto bits = r123::Philox4x32{}(counter, key_);
    const std::uint64_t whole = (static_cast<std::uint64_t>(bits[0]) << 20) ^ (bits[1] >> 12);
    return (static_cast<double>(whole) + 0.5) * 0x1p-52;
  }

  double normal() {  ///< Box-Muller
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  r123::Philox4x32::key_type key_;
  std::uint32_t purpose_;
  std::uint64_t draws_ = 0;
};

}  // namespace shakebed::simulator
