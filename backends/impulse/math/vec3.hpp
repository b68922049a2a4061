// Vectors of three numbers. The number is a template parameter: Real, double for positions, or lanes of Real.
#pragma once

#include "math/real.hpp"

namespace plumb::impulse {

template <class N>
struct Vec3 {
  N x, y, z;

  // No steps from member to member by pointer: compilers may, and gcc 12 does, take what is written so for another
  // place.
  PLUMB_HD constexpr N& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  PLUMB_HD constexpr const N& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

using Vec = Vec3<Real>;
using Position = Vec3<double>;  // of a place in the world; everything relative to a place is a Vec

template <class N>
PLUMB_HD constexpr Vec3<N> operator+(const Vec3<N>& a, const Vec3<N>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
PLUMB_HD constexpr Vec3<N> operator-(const Vec3<N>& a, const Vec3<N>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
PLUMB_HD constexpr Vec3<N> operator-(const Vec3<N>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class N>
PLUMB_HD constexpr Vec3<N> operator*(const N& s, const Vec3<N>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class N>
PLUMB_HD constexpr Vec3<N>& operator+=(Vec3<N>& a, const Vec3<N>& b) {
  return a = a + b;
}
template <class N>
PLUMB_HD constexpr Vec3<N>& operator-=(Vec3<N>& a, const Vec3<N>& b) {
  return a = a - b;
}
template <class N>
PLUMB_HD constexpr bool operator==(const Vec3<N>& a, const Vec3<N>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

template <class N>
PLUMB_HD constexpr N dot(const Vec3<N>& a, const Vec3<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
PLUMB_HD constexpr Vec3<N> cross(const Vec3<N>& a, const Vec3<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
PLUMB_HD inline bool is_finite(const Vec& a) { return is_finite(a.x) && is_finite(a.y) && is_finite(a.z); }
/// Component by component.
template <class N>
PLUMB_HD constexpr Vec3<N> scale(const Vec3<N>& a, const Vec3<N>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class N>
PLUMB_HD constexpr N length_squared(const Vec3<N>& a) {
  return dot(a, a);
}
template <class N>
PLUMB_HD N length(const Vec3<N>& a) {
  return sqrt(dot(a, a));
}
/// a / |a|, or `otherwise` where a is 0 or not finite.
PLUMB_HD inline Vec normalized_or(const Vec& a, const Vec& otherwise) {
  const Real n = length(a);
  return n > 0 ? Vec{a.x / n, a.y / n, a.z / n} : otherwise;
}
template <class N>
PLUMB_HD Vec3<N> abs(const Vec3<N>& a) {
  return {abs(a.x), abs(a.y), abs(a.z)};
}
template <class N>
PLUMB_HD constexpr Vec3<N> min(const Vec3<N>& a, const Vec3<N>& b) {
  return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
template <class N>
PLUMB_HD constexpr Vec3<N> max(const Vec3<N>& a, const Vec3<N>& b) {
  return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}

/// From place `from` to place `to`: formed in double, so that it is as true far from the origin as near it.
PLUMB_HD inline Vec between(const Position& from, const Position& to) {
  return {static_cast<Real>(to.x - from.x), static_cast<Real>(to.y - from.y), static_cast<Real>(to.z - from.z)};
}
PLUMB_HD inline Position moved(const Position& from, const Vec& by) {
  return {from.x + static_cast<double>(by.x), from.y + static_cast<double>(by.y), from.z + static_cast<double>(by.z)};
}

/// A unit vector at right angles to the unit vector n. Continuous except where |n.x| passes |n.z|.
PLUMB_HD inline Vec perpendicular(const Vec& n) {
  const Vec p = abs(n.x) > abs(n.z) ? Vec{-n.y, n.x, 0} : Vec{0, -n.z, n.y};
  return normalized_or(p, {1, 0, 0});
}

}  // namespace plumb::impulse
