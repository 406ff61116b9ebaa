#pragma once

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

/// Numbers of the listed pairs that may meet within `left`, in rising order.
inline void find_meeting(const RowStore& rows, const std::vector<Promise>& promises,
                         const OuterList& list, double left, std::vector<std::uint32_t>& found) {
  found.clear();
  const SeenRow* seen = rows.seen.data();
  for (std::size_t k = 0; k < list.size(); k += lane_count) {
    Four x[lane_count], v[lane_count];
    alignas(64) double width[lane_count];
    for (std::size_t q = 0; q < lane_count; ++q) {
      const std::uint32_t i = list.i()[k + q];
      const std::uint32_t j = list.j()[k + q];
      const Four a = __builtin_convertvector(promises[i], Four);
      const Four b = __builtin_convertvector(promises[j], Four);
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
    for (std::size_t q = 0; q < lane_count && k + q < list.size(); ++q) {
      if (meet[q]) found.push_back(static_cast<std::uint32_t>(k + q));
    }
  }
}

}  // namespace shakebed::simulator
