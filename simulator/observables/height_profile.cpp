#include "simulator/observables/height_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "simulator/lanes.hpp"

namespace shakebed::simulator {

template <>
double part_below<3>(double s) {
  // Cap of height h = s + R of a sphere of R = 1/2, over its volume: h^2 (3R - h) pi/3 / (pi/6).
  const double h = s + 0.5;
  return h * h * (3 - 2 * h);
}

template <>
double part_below<2>(double s) {
  const double x = std::clamp(2 * s, -1.0, 1.0);
  return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
}

namespace {

constexpr int table_intervals = 1024;

std::array<double, table_intervals + 2> tabulated_disc() {
  std::array<double, table_intervals + 2> parts{};
  for (int k = 0; k <= table_intervals + 1; ++k) {
    parts[static_cast<std::size_t>(k)] = part_below<2>(1.0 * k / table_intervals - 0.5);
  }
  return parts;
}

const auto disc_below = tabulated_disc();

/// part_below, fast enough to be asked at every sample: a disc's is read off a table (error < 1e-5,
/// and 1e-7 on average over heights).
template <int D>
inline double part_below_quickly(double s) {
  if constexpr (D == 3) {
    return part_below<3>(s);
  } else {
    const double place = (s + 0.5) * table_intervals;
    const auto k = static_cast<std::size_t>(place);
    return disc_below[k] + (place - static_cast<double>(k)) * (disc_below[k + 1] - disc_below[k]);
  }
}

/// The box of a centre so high above the lowest one's bottom; those below it belong to it too.
inline std::size_t box_of(double above) { return static_cast<std::size_t>(above > 0 ? above : 0); }

double largest(const std::vector<double>& values) {
  Lanes most = values.front();
  std::size_t k = 0;
  for (; k + lane_count <= values.size(); k += lane_count) {
    most = std::experimental::max(most, load_lanes(&values[k]));
  }
  double all = std::experimental::hmax(most);
  for (; k < values.size(); ++k) all = std::max(all, values[k]);
  return all;
}

/// Jackknife over blocks of a vector-valued statistic of summed blocks, which are `width` long (a
/// block ends where nothing was above it).
std::vector<Estimate> jackknife(
    const std::vector<std::vector<double>>& blocks, const std::vector<long>& samples,
    std::size_t width,
    const std::function<std::vector<double>(const std::vector<double>&, double)>& statistic) {
  std::vector<double> total(width, 0);
  double total_samples = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t k = 0; k < blocks[b].size(); ++k) total[k] += blocks[b][k];
    total_samples += static_cast<double>(samples[b]);
  }
  const auto centre = statistic(total, total_samples);
  std::vector<double> sum(centre.size(), 0);
  std::vector<double> square(centre.size(), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    auto rest = total;
    for (std::size_t k = 0; k < blocks[b].size(); ++k) rest[k] -= blocks[b][k];
    const auto value = statistic(rest, total_samples - static_cast<double>(samples[b]));
    for (std::size_t q = 0; q < value.size(); ++q) {
      sum[q] += value[q] - centre[q];
      square[q] += (value[q] - centre[q]) * (value[q] - centre[q]);
    }
  }
  const auto n = static_cast<double>(blocks.size());
  std::vector<Estimate> result(centre.size());
  for (std::size_t q = 0; q < centre.size(); ++q) {
    result[q].mean = centre[q];
    if (blocks.size() >= 4) {
      const double variance = (n - 1) / n * (square[q] - sum[q] * sum[q] / n);
      result[q].standard_error = std::sqrt(std::max(0.0, variance));
    }
  }
  return result;
}

const char* component_name(int dimension, int component) {
  if (dimension == 2) return component == 0 ? "T_x" : "T_z";
  constexpr const char* names[] = {"T_x", "T_y", "T_z"};
  return names[component];
}

}  // namespace

template <int D>
HeightProfile<D>::HeightProfile(double lowest, double area, LocalMean local_mean)
    : lowest_(lowest),
      area_(area),
      local_mean_(local_mean),
      stride_(first_of_phases + (local_mean == LocalMean::phase ? phases * (1 + D) : 0)) {}

template <int D>
void HeightProfile<D>::grow(std::size_t boxes) {
  boxes_ = boxes;
  current_.resize(boxes_ * stride_, 0.0);
  if (local_mean_ == LocalMean::instant) instant_.resize(boxes_ * stride_, 0.0);
}

template <int D>
void HeightProfile<D>::fold_instant() {
  for (std::size_t k = 0; k < boxes_; ++k) {
    double* here = instant_.data() + k * stride_;
    const double count = here[0];
    if (count == 0) continue;
    double* sums = current_.data() + k * stride_;
    sums[0] += count;
    for (int c = 0; c < D; ++c) {
      const double mean = here[1 + 2 * c] / count;
      if (count >= 2) sums[2 + 2 * c] += here[2 + 2 * c] / count - mean * mean;
    }
    std::fill(here, here + stride_, 0.0);
  }
}

template <int D>
void HeightProfile<D>::sample(const std::vector<double>& z, const Columns<D>& velocity,
                              const BaseState& origin, std::size_t phase) {
  const double shift = origin.height + lowest_;
  const auto boxes = static_cast<std::size_t>(std::max(largest(z) - shift, 0.0)) + 2;
  if (boxes > boxes_) grow(boxes);
  double* const all = (local_mean_ == LocalMean::instant ? instant_ : current_).data();
  double* const volumes = current_.data() + volume;
  const double* const heights = z.data();
  std::array<const double*, D> velocities;
  for (int c = 0; c < D; ++c) velocities[c] = velocity[c].data();
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double above = heights[i] - shift;
    const std::size_t box = box_of(above);
    double* sums = all + box * stride_;
    sums[0] += 1;
    for (int c = 0; c < D; ++c) {
      const double v = velocities[c][i] - (c == Dimension<D>::vertical ? origin.velocity : 0);
      sums[1 + 2 * c] += v;
      sums[2 + 2 * c] += v * v;
    }

    // A grain of diameter d in boxes of depth d reaches into one neighbour, above or below: no
    // branch, as nobody can guess which. What is below the lowest box is dropped.
    const double offset = above - static_cast<double>(box) - 0.5;
    const double outside = part_below_quickly<D>(std::abs(offset) - 0.5);
    const std::size_t neighbour = offset > 0 ? box + 1 : box - (box > 0 ? 1 : 0);
    volumes[box * stride_] += 1 - outside;
    volumes[neighbour * stride_] += neighbour == box ? 0 : outside;
  }
  if (local_mean_ == LocalMean::instant) fold_instant();
  if (local_mean_ == LocalMean::phase) add_to_phase(z, velocity, origin, phase);
  ++samples_;
}

/// Counts and velocities once more, apart for each phase of the cycle.
template <int D>
void HeightProfile<D>::add_to_phase(const std::vector<double>& z, const Columns<D>& velocity,
                                    const BaseState& origin, std::size_t phase) {
  const double shift = origin.height + lowest_;
  double* const of_phase = current_.data() + first_of_phases + phase * (1 + D);
  for (std::size_t i = 0; i < z.size(); ++i) {
    double* sums = of_phase + box_of(z[i] - shift) * stride_;
    sums[0] += 1;
    for (int c = 0; c < D; ++c) {
      sums[1 + c] += velocity[c][i] - (c == Dimension<D>::vertical ? origin.velocity : 0);
    }
  }
}

template <int D>
void HeightProfile<D>::end_cycle() {
  if (++cycles_in_current_ < cycles_per_block_) return;
  blocks_.push_back(current_);
  block_samples_.push_back(samples_);
  std::fill(current_.begin(), current_.end(), 0.0);
  samples_ = 0;
  cycles_in_current_ = 0;
  if (blocks_.size() < most_blocks) return;
  for (std::size_t b = 0; b < most_blocks / 2; ++b) {
    auto merged = std::move(blocks_[2 * b]);
    const auto& second = blocks_[2 * b + 1];
    merged.resize(std::max(merged.size(), second.size()), 0.0);
    for (std::size_t k = 0; k < second.size(); ++k) merged[k] += second[k];
    blocks_[b] = std::move(merged);
    block_samples_[b] = block_samples_[2 * b] + block_samples_[2 * b + 1];
  }
  blocks_.resize(most_blocks / 2);
  block_samples_.resize(most_blocks / 2);
  cycles_per_block_ *= 2;
}

template <int D>
double HeightProfile<D>::height_below_which(const Sums& sums, double fraction) const {
  double total = 0;
  const std::size_t boxes = sums.size() / stride_;
  for (std::size_t k = 0; k < boxes; ++k) total += sums[k * stride_];
  double below = 0;
  for (std::size_t k = 0; k < boxes; ++k) {
    const double here = sums[k * stride_];
    if (here > 0 && below + here >= fraction * total) {
      return lowest_ + static_cast<double>(k) + (fraction * total - below) / here;
    }
    below += here;
  }
  return lowest_ + static_cast<double>(boxes);
}

template <int D>
double HeightProfile<D>::local_temperature(const Sums& sums, double samples, std::size_t box,
                                           int component) const {
  const double* s = sums.data() + box * stride_;
  if (local_mean_ == LocalMean::instant) return 0.5 * s[2 + 2 * component] / samples;
  if (s[0] < 2) return 0;
  if (local_mean_ == LocalMean::phase) {
    double square_of_means = 0;
    for (std::size_t p = 0; p < phases; ++p) {
      const double* of_phase = s + first_of_phases + p * (1 + D);
      const double sum = of_phase[1 + component];
      if (of_phase[0] > 0) square_of_means += sum * sum / of_phase[0];
    }
    return 0.5 * (s[2 + 2 * component] - square_of_means) / s[0];
  }
  const double mean = s[1 + 2 * component] / s[0];
  return 0.5 * (s[2 + 2 * component] / s[0] - mean * mean);
}

template <int D>
std::vector<double> HeightProfile<D>::volume_averages(const Sums& sums, double height,
                                                      double samples) const {
  std::vector<double> averages(D + 2, 0.0);
  double grains = 0;
  for (std::size_t k = 0; k < sums.size() / stride_; ++k) {
    const double bottom = std::max(lowest_ + static_cast<double>(k), 0.0);
    const double top = std::min(lowest_ + static_cast<double>(k + 1), height);
    grains += sums[k * stride_];
    if (top <= bottom) continue;
    for (int c = 0; c < D; ++c) {
      averages[c] += (top - bottom) * local_temperature(sums, samples, k, c) / height;
    }
  }
  for (int c = 0; c < D; ++c) averages[D] += averages[c] / D;
  const double grain_size = D == 3 ? grain_volume : grain_cross_section_area;
  averages[D + 1] = grains / samples * grain_size / (area_ * height);
  return averages;
}

template <int D>
typename HeightProfile<D>::Summary HeightProfile<D>::summarise() const {
  Summary summary{};
  // Tall profiles are most of a bed's memory, so that finished blocks are read where they are.
  const bool unfinished = blocks_.empty();
  const std::vector<Sums> first = unfinished ? std::vector<Sums>{current_} : std::vector<Sums>{};
  const auto& blocks = unfinished ? first : blocks_;
  const auto samples = unfinished ? std::vector<long>{samples_} : block_samples_;
  const std::size_t width = boxes_ * stride_;

  Sums total(width, 0.0);
  for (const auto& block : blocks) {
    for (std::size_t k = 0; k < block.size(); ++k) total[k] += block[k];
  }
  summary.averaging_height = height_below_which(total, 0.99);

  const double grain_size = D == 3 ? grain_volume : grain_cross_section_area;
  const auto local = jackknife(blocks, samples, width, [&](const Sums& sums, double n) {
    std::vector<double> values;
    for (std::size_t k = 0; k < boxes_; ++k) {
      values.push_back(sums[k * stride_] / n);
      values.push_back(sums[k * stride_ + volume] / n * grain_size / area_);
      for (int c = 0; c < D; ++c) values.push_back(local_temperature(sums, n, k, c));
    }
    return values;
  });
  const auto averages = jackknife(blocks, samples, width, [&](const Sums& sums, double n) {
    return volume_averages(sums, height_below_which(sums, 0.99), n);
  });

  summary.profile.box_depth = 1;
  summary.profile.columns = {{"grains_in_box", "1", {}, {}}, {"phi", "1", {}, {}}};
  for (int c = 0; c < D; ++c) {
    summary.profile.columns.push_back({component_name(D, c), "m g d", {}, {}});
  }
  const std::size_t columns = summary.profile.columns.size();
  for (std::size_t k = 0; k < boxes_; ++k) {
    summary.profile.z.push_back(lowest_ + static_cast<double>(k) + 0.5);
    for (std::size_t q = 0; q < columns; ++q) {
      summary.profile.columns[q].mean.push_back(local[k * columns + q].mean);
      summary.profile.columns[q].standard_error.push_back(local[k * columns + q].standard_error);
    }
  }
  summary.volume_temperature.assign(averages.begin(), averages.begin() + D + 1);
  summary.packing_fraction = averages[D + 1];
  return summary;
}

template class HeightProfile<2>;
template class HeightProfile<3>;

}  // namespace shakebed::simulator
