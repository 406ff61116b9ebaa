#pragma once

namespace shakebed::simulator {

/// Three Cartesian components, each a number or a SIMD vector of numbers: a law written with it
/// serves one contact or as many as the machine handles at once, with the same rounding.
template <class Real>
struct Triple {
  Real x, y, z;

  [[gnu::always_inline]] Triple& operator+=(const Triple& b) {
    return *this = {x + b.x, y + b.y, z + b.z};
  }
  [[gnu::always_inline]] Triple& operator-=(const Triple& b) {
    return *this = {x - b.x, y - b.y, z - b.z};
  }
};

template <class Real>
[[gnu::always_inline]] inline Triple<Real> operator+(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
[[gnu::always_inline]] inline Triple<Real> operator-(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
[[gnu::always_inline]] inline Triple<Real> operator*(const Real& a, const Triple<Real>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
template <class Real>
[[gnu::always_inline]] inline Real dot(const Triple<Real>& a, const Triple<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
[[gnu::always_inline]] inline Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace shakebed::simulator
