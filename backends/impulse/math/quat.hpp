// Unit quaternions: orientations and rotations.
#pragma once

#include "math/vec3.hpp"

namespace plumb::impulse {

template <class N>
struct Quat4 {
  N x, y, z, w;
};
using Quat = Quat4<Real>;

template <class N>
PLUMB_HD constexpr Vec3<N> vector_part(const Quat4<N>& q) {
  return {q.x, q.y, q.z};
}
template <class N>
PLUMB_HD constexpr Quat4<N> conjugate(const Quat4<N>& q) {
  return {-q.x, -q.y, -q.z, q.w};
}
template <class N>
PLUMB_INLINE constexpr Quat4<N> operator*(const Quat4<N>& a, const Quat4<N>& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
/// q v q*, in the form v + 2 u x (u x v + w v), u the vector part.
template <class N>
PLUMB_INLINE constexpr Vec3<N> rotate(const Quat4<N>& q, const Vec3<N>& v) {
  const Vec3<N> u = vector_part(q);
  const Vec3<N> t = cross(u, v);
  const Vec3<N> s = t + t;
  return v + q.w * s + cross(u, s);
}
template <class N>
PLUMB_INLINE constexpr Vec3<N> rotate_back(const Quat4<N>& q, const Vec3<N>& v) {
  return rotate(conjugate(q), v);
}
/// By how much a turn changes a vector: nothing at all where it is none.
template <class N>
PLUMB_HD Vec3<N> change_by_turn(const Quat4<N>& turn, const Vec3<N>& v) {
  const Vec3<N> u = vector_part(turn);
  const Vec3<N> t = cross(u, v);
  const Vec3<N> s = t + t;
  return turn.w * s + cross(u, s);
}
template <class N>
PLUMB_HD Quat4<N> normalized(const Quat4<N>& q) {
  const N n = sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {q.x / n, q.y / n, q.z / n, q.w / n};
}

/// A placement: p of the local frame is at position + rotate(orientation, p).
struct Frame {
  Vec position;
  Quat orientation;
};

}  // namespace plumb::impulse
