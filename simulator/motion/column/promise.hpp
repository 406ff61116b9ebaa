#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <limits>
#include <vector>

#include "simulator/motion/column/outer_list.hpp"
#include "simulator/motion/column/row_store.hpp"
#include "simulator/motion/may_meet.hpp"

namespace shakebed::simulator {

/// What a row promises for a window: that its velocity is, but for what the common field adds, the
/// one in the first three lanes, give or take the width in the fourth.
using Promise = Four;

inline Promise make_promise(const Four& velocity, double width) {
  return Promise{velocity[0], velocity[1], velocity[2], width};
}

inline double length(const Four& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// The promises of all rows.
class Promises {
 public:
  explicit Promises(std::size_t room)
      : of_(room, Promise{}), width_(room, width_least), width_from_below_(room, width_least) {}

  static constexpr double width_share = 1;     // of the speed at which its contacts close, ...
  static constexpr double width_least = 0.05;  // ... and [sqrt(g d)] more

  double width(std::uint32_t i) const { return of_[i][3]; }

  /// A new window: nothing has fallen, and rows of [begin, end) know of no contacts yet.
  void begin_window() { fallen_ = Four{}; }
  void forget_contacts(std::uint32_t begin, std::uint32_t end) {
    std::fill(width_.begin() + begin, width_.begin() + end, width_least);
    std::fill(width_from_below_.begin() + begin, width_from_below_.begin() + end, width_least);
  }
  /// Rows i and j are in contact and part or close at `speed`; rows from `end` on belong to another
  /// block.
  void note_contact(std::uint32_t i, std::uint32_t j, double speed, std::uint32_t end) {
    for (const auto k : {i, j}) {
      double& w = (k < end ? width_ : width_from_below_)[k];
      w = std::max(w, width_share * speed + width_least);
    }
  }
  void promise(const RowStore& rows, std::uint32_t i, double more_width) {
    const double width = std::max(width_[i], width_from_below_[i]) + more_width;
    of_[i] = make_promise(rows.own[i].half_velocity, width);
  }

  /// The common field was added to all velocities for one more step.
  void note_fall(const Four& change) { fallen_ += change; }

  const Four& fallen() const { return fallen_; }

  /// How far off its promise row i is, and in the fourth lane how far it may be; `velocity` less
  /// what has fallen, with 0 in its fourth lane.
  [[gnu::always_inline]] Four off(std::uint32_t i, const Four& velocity) const {
    return velocity - of_[i];
  }
  /// Which of a vector's rows have another velocity than promised.
  [[gnu::always_inline]] static LaneMask broken(const Four* off) {
    Lanes column[4];
    transpose_rows(off, column);
    for (auto& one : column) one *= one;
    return column[0] + column[1] + column[2] > column[3];
  }
  /// A wider promise from now on.
  void renew(const RowStore& rows, std::uint32_t i) {
    of_[i] = make_promise(rows.own[i].half_velocity - fallen_, 2 * width(i) + width_least);
  }

  /// Which of a vector of pairs, r apart, may meet within `left`.
  [[gnu::always_inline]] LaneMask let_meet(const std::uint32_t* i, const std::uint32_t* j,
                                           const LaneTriple& r, const Lanes& size,
                                           double left) const {
    Four apart[lane_count];
    for (std::size_t q = 0; q < lane_count; ++q) apart[q] = width_added(of_[i[q]], of_[j[q]]);
    Lanes w[4];
    transpose_rows(apart, w);
    const LaneTriple velocity{w[0], w[1], w[2]};
    return may_meet(dot(r, r), dot(r, velocity), dot(velocity, velocity), size, w[3], left);
  }

  /// Of the first `count` of `pairs` of `list`, those that may meet within `left` are found. Row i
  /// is at `place_of(i)`.
  template <class PlaceOf>
  void find_meeting(const OuterList& list, const std::uint32_t* pairs, std::size_t count,
                    PlaceOf place_of, double left, std::vector<std::uint32_t>& found) const {
    std::uint32_t i[lane_count], j[lane_count];
    Four x[lane_count];
    alignas(64) double size[lane_count];
    for (std::size_t q = 0; q < lane_count; ++q) {
      const std::uint32_t k = pairs[std::min(q, count - 1)];
      i[q] = list.i()[k];
      j[q] = list.j()[k];
      x[q] = place_of(i[q]) - place_of(j[q]);
      size[q] = list.contact_size()[k];
    }
    const LaneMask meet = let_meet(i, j, transposed(x), load_lanes(size), left);
    if (std::experimental::none_of(meet)) return;
    for (std::size_t q = 0; q < count; ++q) {
      if (meet[q]) found.push_back(pairs[q]);
    }
  }

  template <class Archive>
  void archive(Archive& a) {
    a(of_);
    a(fallen_);
  }

 private:
  /// a - b, but for the fourth lane: there a + b.
  [[gnu::always_inline]] static Four width_added(const Four& a, const Four& b) {
    constexpr auto sign = std::numeric_limits<long long>::min();
    return a +
           reinterpret_cast<Four>(reinterpret_cast<FourBits>(b) ^ FourBits{sign, sign, sign, 0});
  }

  std::vector<Promise> of_;
  std::vector<double> width_;
  std::vector<double> width_from_below_;  ///< what contacts say that the block below reckons with
  Four fallen_{};  ///< what the common field added to velocities since the beginning
};

/// Numbers of the pairs [begin, end) of `list` that may meet within `left`, in rising order: those
/// that touch already, and all others.
struct MeetingPairs {
  std::vector<std::uint32_t> touching;
  std::vector<std::uint32_t> apart;

  void find(const RowStore& rows, const Promises& promises, const OuterList& list,
            std::size_t begin, std::size_t end, double left) {
    touching.resize(end - begin + lane_count);
    apart.resize(end - begin + lane_count);
    std::uint32_t* next_touching = touching.data();
    std::uint32_t* next_apart = apart.data();
    const Four* place = rows.position.data();
    for (std::size_t k = begin; k < end; k += lane_count) {
      const std::uint32_t* i = list.i() + k;
      const std::uint32_t* j = list.j() + k;
      Four x[lane_count];
      for (std::size_t q = 0; q < lane_count; ++q) x[q] = place[i[q]] - place[j[q]];
      const LaneTriple r = transposed(x);
      const Lanes size = load_lanes(list.contact_size() + k);
      const LaneMask meet = promises.let_meet(i, j, r, size, left);
      const LaneMask touch = size - std::experimental::sqrt(dot(r, r)) > Lanes(0.0);
      const auto number = [&](std::size_t q) { return static_cast<std::uint32_t>(k + q); };
      next_touching = put_set_lanes(touch, number, next_touching);
      next_apart = put_set_lanes(meet && !touch, number, next_apart);
    }
    cut(touching, next_touching, end);
    cut(apart, next_apart, end);
  }

 private:
  /// Leaves what stands before `past_last` and is below `end`: the last vector reaches farther.
  static void cut(std::vector<std::uint32_t>& found, const std::uint32_t* past_last,
                  std::size_t end) {
    auto count = static_cast<std::size_t>(past_last - found.data());
    while (count > 0 && found[count - 1] >= end) --count;
    found.resize(count);
  }
};

}  // namespace shakebed::simulator
