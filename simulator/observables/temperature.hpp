#pragma once

#include <array>
#include <vector>

#include "simulator/dimension.hpp"
#include "simulator/grains/grains.hpp"

namespace shakebed::simulator {

/// Sums of a column and of its squares in eight interleaved parts: in order, the machine would wait
/// for every addition; so, it adds in whatever lanes it has, and rounds alike in all of them.
struct ColumnSums {
  double sum = 0;
  double square = 0;

  explicit ColumnSums(const std::vector<double>& column) {
    constexpr std::size_t parts = 8;
    std::array<double, parts> sums{};
    std::array<double, parts> squares{};
    std::size_t i = 0;
    for (; i + parts <= column.size(); i += parts) {
      for (std::size_t k = 0; k < parts; ++k) {
        sums[k] += column[i + k];
        squares[k] += column[i + k] * column[i + k];
      }
    }
    for (std::size_t k = 0; i + k < column.size(); ++k) {
      sums[k] += column[i + k];
      squares[k] += column[i + k] * column[i + k];
    }
    for (std::size_t k = 0; k < parts; ++k) {
      sum += sums[k];
      square += squares[k];
    }
  }
};

/// Per-cycle averages over equal phases of the granular temperature's components (Bhateja 2016,
/// Eq. 5, with its factor 1/2): T_c = (m/2) <(v_c - <v_c>)^2>, the mean <.> taken over grains at
/// one instant, so that motion of the bed as a whole does not count; T_c_lab = (m/2) <v_c^2> keeps
/// it. (Removing the mean of n grains costs a gas at rest as a whole the factor (n - 1)/n.)
template <int D>
class TemperatureSums {
 public:
  template <class GrainState>
  void sample(const GrainState& grains) {
    const auto n = static_cast<double>(grains.count());
    for (int c = 0; c < D; ++c) {
      const ColumnSums v(grains.velocity[c]);
      const double mean = v.sum / n;
      lab_[c] += 0.5 * v.square / n;
      removed_[c] += 0.5 * (v.square / n - mean * mean);
    }
    height_ += ColumnSums(grains.position[Dimension<D>::vertical]).sum / n;
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
