// Poses and vectors between the wall's plain values and ODE's arrays, in double on both sides.
#pragma once

#include <ode/ode.h>

#include "plumb/backend/small_math.hpp"

namespace plumb::ode {

using backend::add;
using backend::cross;
using backend::dot;
using backend::length;
using backend::Matrix3;
using backend::scale;
using backend::sub;

[[nodiscard]] inline PlumbVec3 vec(const dReal* v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline bool is_zero(const PlumbVec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

/// ODE keeps w first.
[[nodiscard]] inline PlumbQuat quat(const dReal* q) { return {q[1], q[2], q[3], q[0]}; }

struct OdeQuaternion {
  explicit OdeQuaternion(const PlumbQuat& q) : wxyz{q.w, q.x, q.y, q.z} {}
  dQuaternion wxyz;
};

[[nodiscard]] constexpr PlumbQuat conjugate(const PlumbQuat& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// First b, then a.
[[nodiscard]] constexpr PlumbQuat multiply(const PlumbQuat& a, const PlumbQuat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// An identity leaves the bits of v alone.
[[nodiscard]] constexpr PlumbVec3 rotate(const PlumbQuat& q, const PlumbVec3& v) {
  if (q.x == 0 && q.y == 0 && q.z == 0) return v;
  const PlumbVec3 u{q.x, q.y, q.z};
  const PlumbVec3 t = scale(2, cross(u, v));
  return add(v, add(scale(q.w, t), cross(u, t)));
}

[[nodiscard]] constexpr PlumbVec3 unrotate(const PlumbQuat& q, const PlumbVec3& v) { return rotate(conjugate(q), v); }

/// The placement of `inner`, given in `outer`'s frame, in the frame of `outer`.
[[nodiscard]] constexpr PlumbPose compose(const PlumbPose& outer, const PlumbPose& inner) {
  return {add(outer.position, rotate(outer.orientation, inner.position)),
          multiply(outer.orientation, inner.orientation)};
}

[[nodiscard]] constexpr PlumbPose inverse(const PlumbPose& pose) {
  const PlumbQuat back = conjugate(pose.orientation);
  return {rotate(back, scale(-1, pose.position)), back};
}

[[nodiscard]] inline PlumbVec3 normalized(const PlumbVec3& v) { return scale(1 / length(v), v); }

/// Rotation vector (axis times angle, shortest way) of a unit quaternion.
[[nodiscard]] inline PlumbVec3 rotation_vector(const PlumbQuat& q) {
  const PlumbVec3 u{q.x, q.y, q.z};
  const double sine = length(u);
  if (sine < 1e-12) return scale(q.w < 0 ? -2 : 2, u);
  const double angle = 2 * std::atan2(q.w < 0 ? -sine : sine, std::abs(q.w));
  return scale(angle / sine, u);
}

}  // namespace plumb::ode
