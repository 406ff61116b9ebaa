#pragma once

#include <experimental/simd>

namespace shakebed::simulator {

/// `here` where the condition holds, else `there`.
inline double chosen(bool condition, double here, double there) { return condition ? here : there; }
template <class Simd>
[[gnu::always_inline]] inline Simd chosen(const typename Simd::mask_type& condition,
                                          const Simd& here, Simd there) {
  std::experimental::where(condition, there) = here;
  return there;
}

}  // namespace shakebed::simulator
