#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <vector>

#include "simulator/motion/column/outer_list.hpp"
#include "simulator/motion/column/row_store.hpp"
#include "simulator/motion/may_meet.hpp"

namespace shakebed::simulator {

/// What a row promises for a window: that its velocity is, but for what the common field adds, the
/// one in the first three lanes, give or take the width in the fourth. Single precision serves:
/// whether a promise is kept is asked of these very numbers.
using Promise = float __attribute__((vector_size(16)));

inline Promise make_promise(const Four& velocity, double width) {
  Four wide = velocity;
  wide[3] = width;
  return __builtin_convertvector(wide, Promise);
}

inline double length(const Four& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

/// The promises of all rows.
class Promises {
 public:
  explicit Promises(std::size_t room)
      : of_(room, Promise{}), width_(room, width_least), width_from_below_(room, width_least) {}

  static constexpr double width_share = 1;     // of the speed at which its contacts close, ...
  static constexpr double width_least = 0.05;  // ... and [sqrt(g d)] more

  const Promise* data() const { return of_.data(); }
  double width(std::uint32_t i) const { return static_cast<double>(of_[i][3]); }

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

  /// Whether row i has another velocity than promised, `velocity` being less what has fallen.
  bool broken(std::uint32_t i, const Four& velocity) const {
    const Four promised = __builtin_convertvector(of_[i], Four);
    const Four off = velocity - promised;
    const Four square = off * off;
    return square[0] + square[1] + square[2] > promised[3] * promised[3];
  }
  /// A wider promise from now on.
  void renew(const RowStore& rows, std::uint32_t i) {
    of_[i] = make_promise(rows.own[i].half_velocity - fallen_, 2 * width(i) + width_least);
  }

  /// Whether rows i and j, r apart, may meet within `left`.
  bool let_meet(std::uint32_t i, std::uint32_t j, const Four& r, double size, double left) const {
    const Four a = __builtin_convertvector(of_[i], Four);
    const Four b = __builtin_convertvector(of_[j], Four);
    const Four w = a - b;
    const auto dot3 = [](const Four& p, const Four& q) {
      return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    };
    return may_meet(dot3(r, r), dot3(r, w), dot3(w, w), size, a[3] + b[3], left);
  }

  template <class Archive>
  void archive(Archive& a) {
    a(of_);
    a(fallen_);
  }

 private:
  std::vector<Promise> of_;
  std::vector<double> width_;
  std::vector<double> width_from_below_;  ///< what contacts say that the block below reckons with
  Four fallen_{};  ///< what the common field added to velocities since the beginning
};

/// Numbers of the pairs [begin, end) of `list` that may meet within `left`, in rising order.
inline void find_meeting(const RowStore& rows, const Promises& promises, const OuterList& list,
                         std::size_t begin, std::size_t end, double left,
                         std::vector<std::uint32_t>& found) {
  found.clear();
  const SeenRow* seen = rows.seen.data();
  const Promise* promise = promises.data();
  for (std::size_t k = begin; k < end; k += lane_count) {
    Four x[lane_count], v[lane_count];
    alignas(64) double width[lane_count];
    for (std::size_t q = 0; q < lane_count; ++q) {
      const std::uint32_t i = list.i()[k + q];
      const std::uint32_t j = list.j()[k + q];
      const Four a = __builtin_convertvector(promise[i], Four);
      const Four b = __builtin_convertvector(promise[j], Four);
      x[q] = seen[i].position - seen[j].position;
      v[q] = a - b;
      width[q] = a[3] + b[3];
    }
    LaneTriple r, w;
    transpose_rows(x, r);
    transpose_rows(v, w);
    const LaneMask meet = may_meet(dot(r, r), dot(r, w), dot(w, w),
                                   load_lanes(list.contact_size() + k), load_lanes(width), left);
    if (std::experimental::none_of(meet)) continue;
    for (std::size_t q = 0; q < lane_count && k + q < end; ++q) {
      if (meet[q]) found.push_back(static_cast<std::uint32_t>(k + q));
    }
  }
}

}  // namespace shakebed::simulator
