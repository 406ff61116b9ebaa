#pragma once

#include <array>
#include <vector>

#include "simulator/dimension.hpp"
#include "simulator/grains/moments.hpp"

namespace shakebed::simulator {

/// Per-cycle averages over equal phases of the granular temperature's components (Bhateja 2016,
/// Eq. 5, with its factor 1/2): T_c = (m/2) <(v_c - <v_c>)^2>, the mean <.> taken over grains at
/// one instant, so that motion of the bed as a whole does not count; T_c_lab = (m/2) <v_c^2> keeps
/// it. (Removing the mean of n grains costs a gas at rest as a whole the factor (n - 1)/n.)
template <int D>
class TemperatureSums {
 public:
  void sample(const Moments<D>& moments) {
    const double n = moments.count;
    for (int c = 0; c < D; ++c) {
      const double mean = moments.velocity[c] / n;
      lab_[c] += 0.5 * moments.square[c] / n;
      removed_[c] += 0.5 * (moments.square[c] / n - mean * mean);
    }
    height_ += moments.height / n;
    ++samples_;
  }

  /// T_c (D of them), T_c_lab (D), h_cm: averages since the last call.
  std::vector<double> take() {
    std::vector<double> averages;
    const auto n = static_cast<double>(samples_);
    for (const double t : removed_) averages.push_back(t / n);
    for (const double t : lab_) averages.push_back(t / n);
    averages.push_back(height_ / n);
    *this = {};
    return averages;
  }

 private:
  std::array<double, D> removed_{};
  std::array<double, D> lab_{};
  double height_ = 0;
  long samples_ = 0;
};

}  // namespace shakebed::simulator
