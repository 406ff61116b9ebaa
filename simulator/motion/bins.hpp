#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "simulator/boundary/periodic.hpp"
#include "simulator/dimension.hpp"

namespace shakebed::simulator {

/// Grains in flight by lateral bin, for beds too wide to ask every grain about every other. A grain
/// is entered in one bin and stays there until it is `margin` outside it; bins are wider than
/// 1 + 2 margin, so that two grains that touch are in the same bin or in adjacent ones. Whoever
/// changes bin looks for partners again, which is what makes looking at adjacent bins enough.
template <int D>
class Bins {
 public:
  static constexpr int lateral = Dimension<D>::lateral;
  static constexpr double margin = 0.05;

  Bins(const PeriodicCell<D>& cell, std::size_t count) : cell_(cell) {
    constexpr double narrowest = 1.25;
    constexpr std::size_t few = 256;  // so many are asked faster in one sweep over all
    std::size_t total = 1;
    for (int c = 0; c < lateral; ++c) {
      const auto n = static_cast<std::size_t>(cell.width[c] / narrowest);
      bins_[c] = n < 4 ? 1 : n;  // with three bins both neighbours of a bin are the same images
      width_[c] = cell.width[c] / static_cast<double>(bins_[c]);
      total *= bins_[c];
    }
    active_ = count > few && total > 1;
    if (!active_) return;
    members_.resize(total);
    bin_of_.assign(count, nowhere);
    place_.assign(count, 0);
  }

  bool active() const { return active_; }

  void enter(std::uint32_t i, const Vector<D>& x) {
    if (!active_ || (bin_of_[i] != nowhere && well_inside(bin_of_[i], x))) return;
    leave(i);
    const auto bin = flat(index_of(x));
    bin_of_[i] = bin;
    place_[i] = static_cast<std::uint32_t>(members_[bin].size());
    members_[bin].push_back(i);
  }

  void leave(std::uint32_t i) {
    if (!active_ || bin_of_[i] == nowhere) return;
    auto& members = members_[bin_of_[i]];
    const auto last = members.back();
    members[place_[i]] = last;
    place_[last] = place_[i];
    members.pop_back();
    bin_of_[i] = nowhere;
  }

  /// How long grain i, at x with velocity v, stays in its bin.
  double time_to_leave(std::uint32_t i, const Vector<D>& x, const Vector<D>& v) const {
    double time = std::numeric_limits<double>::infinity();
    const auto index = unflat(bin_of_[i]);
    for (int c = 0; c < lateral; ++c) {
      if (bins_[c] == 1 || v[c] == 0) continue;
      const double inside = offset(c, index[c], x[c]);
      const double way = v[c] > 0 ? width_[c] + margin - inside : inside + margin;
      time = std::min(time, std::max(way, 0.0) / std::abs(v[c]));
    }
    return time;
  }

  /// Calls `visit(j)` for every grain in the bin of grain i and the adjacent ones.
  template <class Visit>
  void each_adjacent(std::uint32_t i, Visit visit) const {
    Index away;
    away.fill(1);
    each_around(unflat(bin_of_[i]), away, visit);
  }

  /// Calls `visit(j)` for every grain entered in a bin within `reach` of x.
  template <class Visit>
  void each_near(const Vector<D>& x, double reach, Visit visit) const {
    Index away;
    for (int c = 0; c < lateral; ++c) {
      away[c] = static_cast<std::size_t>((reach + margin) / width_[c]) + 1;
    }
    each_around(index_of(x), away, visit);
  }

 private:
  using Index = std::array<std::size_t, lateral>;
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  template <class Visit>
  void each_around(const Index& centre, const Index& away, Visit visit) const {
    Index first;
    Index number;
    for (int c = 0; c < lateral; ++c) {
      number[c] = std::min(2 * away[c] + 1, bins_[c]);
      first[c] = number[c] == bins_[c] ? 0 : centre[c] + bins_[c] - away[c];
    }
    const std::size_t columns = lateral == 2 ? number[lateral - 1] : 1;
    for (std::size_t a = 0; a < number[0]; ++a) {
      for (std::size_t b = 0; b < columns; ++b) {
        Index at;
        at[0] = (first[0] + a) % bins_[0];
        if constexpr (lateral == 2) at[1] = (first[1] + b) % bins_[1];
        for (const auto j : members_[flat(at)]) visit(j);
      }
    }
  }

  Index index_of(const Vector<D>& x) const {
    Index index;
    for (int c = 0; c < lateral; ++c) {
      const auto n = static_cast<std::size_t>(cell_.wrapped(c, x[c]) / width_[c]);
      index[c] = std::min(n, bins_[c] - 1);
    }
    return index;
  }

  std::uint32_t flat(const Index& index) const {
    std::size_t n = index[0];
    if constexpr (lateral == 2) n = n * bins_[1] + index[1];
    return static_cast<std::uint32_t>(n);
  }

  Index unflat(std::uint32_t bin) const {
    if constexpr (lateral == 2) {
      return {bin / bins_[1], bin % bins_[1]};
    } else {
      return {bin};
    }
  }

  /// Of x from the lower edge of bin `index` in direction c, from -margin up, by nearest image.
  double offset(int c, std::size_t index, double x) const {
    const double inside = cell_.wrapped(c, x - static_cast<double>(index) * width_[c]);
    return inside > 0.5 * (cell_.width[c] + width_[c]) ? inside - cell_.width[c] : inside;
  }

  bool well_inside(std::uint32_t bin, const Vector<D>& x) const {
    const auto index = unflat(bin);
    for (int c = 0; c < lateral; ++c) {
      if (bins_[c] == 1) continue;
      const double inside = offset(c, index[c], x[c]);
      if (inside < -0.5 * margin || inside > width_[c] + 0.5 * margin) return false;
    }
    return true;
  }

  PeriodicCell<D> cell_;
  std::array<std::size_t, lateral> bins_{};
  std::array<double, lateral> width_{};
  bool active_ = false;
  std::vector<std::vector<std::uint32_t>> members_;
  std::vector<std::uint32_t> bin_of_;
  std::vector<std::uint32_t> place_;  ///< in its bin's members
};

}  // namespace shakebed::simulator
