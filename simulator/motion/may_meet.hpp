#pragma once

namespace shakebed::simulator {

/// Whether two grains may meet within `left` whose centres are r apart and whose relative velocity
/// is w, give or take `width`:
///   |r + w t| < size + width t  for a t in [0, left],
/// the squares of which are a t^2 + 2 b t + c < 0 with a = w^2 - width^2, b = r.w - size width,
/// c = r^2 - size^2. Sizes are taken 1e-9 larger and widths 1.001 times, for rounding.
template <class Real>
[[gnu::always_inline]] inline auto may_meet(const Real& r_r, const Real& r_w, const Real& w_w,
                                            const Real& size, const Real& width, double left) {
  const Real wide_size = Real(1 + 1e-9) * size;
  const Real wide_width = Real(1.001) * width;
  const Real a = w_w - wide_width * wide_width;
  const Real b = r_w - wide_size * wide_width;
  const Real c = r_r - wide_size * wide_size;
  const Real zero(0.0);
  const auto lowest_within = b < zero && Real(-1.0) * b < Real(left) * a;
  const auto met_at_lowest = lowest_within && a * c < b * b;
  const auto met_at_end = (Real(left) * a + Real(2.0) * b) * Real(left) + c < zero;
  return c <= zero || met_at_lowest || (!lowest_within && met_at_end);
}

}  // namespace shakebed::simulator
