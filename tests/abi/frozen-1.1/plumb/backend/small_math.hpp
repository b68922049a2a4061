// The little vector algebra that the headers for backends need, on the plain values of the wall, in double.
#pragma once

#include <cmath>
#include <cstddef>

#include "plumb/types.h"

namespace plumb::backend {

[[nodiscard]] constexpr PlumbVec3 add(const PlumbVec3& a, const PlumbVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr PlumbVec3 sub(const PlumbVec3& a, const PlumbVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr PlumbVec3 scale(double s, const PlumbVec3& a) { return {s * a.x, s * a.y, s * a.z}; }
[[nodiscard]] constexpr double dot(const PlumbVec3& a, const PlumbVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr PlumbVec3 cross(const PlumbVec3& a, const PlumbVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(const PlumbVec3& a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline PlumbVec3 normalized(const PlumbVec3& v) { return scale(1 / length(v), v); }

[[nodiscard]] constexpr PlumbQuat conjugate(const PlumbQuat& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// First b, then a.
[[nodiscard]] constexpr PlumbQuat multiply(const PlumbQuat& a, const PlumbQuat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// Of unit length.
[[nodiscard]] inline PlumbQuat normalized(const PlumbQuat& q) {
  const double n = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {n * q.x, n * q.y, n * q.z, n * q.w};
}

/// By a unit quaternion. An identity leaves the bits of v alone.
[[nodiscard]] constexpr PlumbVec3 rotate(const PlumbQuat& q, const PlumbVec3& v) {
  if (q.x == 0 && q.y == 0 && q.z == 0) return v;
  const PlumbVec3 u{q.x, q.y, q.z};
  const PlumbVec3 t = scale(2, cross(u, v));
  return add(v, add(scale(q.w, t), cross(u, t)));
}
/// The other way.
[[nodiscard]] constexpr PlumbVec3 unrotate(const PlumbQuat& q, const PlumbVec3& v) { return rotate(conjugate(q), v); }

/// Axis times angle, rad, of a unit quaternion, the shorter way round: what a body turns by. Divided by a time it is
/// the angular velocity, in world axes, of one that turns from a to b where q = multiply(b, conjugate(a)).
[[nodiscard]] inline PlumbVec3 rotation_vector(const PlumbQuat& q) {
  const PlumbVec3 u{q.x, q.y, q.z};
  const double sine = length(u);
  if (sine < 1e-12) return scale(q.w < 0 ? -2 : 2, u);
  const double angle = 2 * std::atan2(q.w < 0 ? -sine : sine, std::abs(q.w));
  return scale(angle / sine, u);
}

/// The pose of `inner`, given in the frame of `outer`, in the frame that `outer` is given in.
[[nodiscard]] constexpr PlumbPose compose(const PlumbPose& outer, const PlumbPose& inner) {
  return {add(outer.position, rotate(outer.orientation, inner.position)),
          multiply(outer.orientation, inner.orientation)};
}
[[nodiscard]] constexpr PlumbPose inverse(const PlumbPose& pose) {
  const PlumbQuat back = conjugate(pose.orientation);
  return {rotate(back, scale(-1, pose.position)), back};
}

/// A 3x3 matrix, row by row.
struct Matrix3 {
  double m[3][3];

  [[nodiscard]] static constexpr Matrix3 diagonal(double x, double y, double z) {
    return {{{x, 0, 0}, {0, y, 0}, {0, 0, z}}};
  }
  double* operator[](std::size_t row) { return m[row]; }
  const double* operator[](std::size_t row) const { return m[row]; }
};

[[nodiscard]] inline Matrix3 multiply(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}
[[nodiscard]] inline Matrix3 transpose(const Matrix3& a) {
  Matrix3 t{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = a[j][i];
  return t;
}
[[nodiscard]] inline PlumbVec3 multiply(const Matrix3& a, const PlumbVec3& v) {
  return {a[0][0] * v.x + a[0][1] * v.y + a[0][2] * v.z, a[1][0] * v.x + a[1][1] * v.y + a[1][2] * v.z,
          a[2][0] * v.x + a[2][1] * v.y + a[2][2] * v.z};
}

/// q need not be of unit length exactly: its length is divided out.
[[nodiscard]] inline Matrix3 rotation_matrix(const PlumbQuat& q) {
  const double s = 2 / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {{{1 - s * (q.y * q.y + q.z * q.z), s * (q.x * q.y - q.z * q.w), s * (q.x * q.z + q.y * q.w)},
           {s * (q.x * q.y + q.z * q.w), 1 - s * (q.x * q.x + q.z * q.z), s * (q.y * q.z - q.x * q.w)},
           {s * (q.x * q.z - q.y * q.w), s * (q.y * q.z + q.x * q.w), 1 - s * (q.x * q.x + q.y * q.y)}}};
}

/// Of a proper rotation; w >= 0. Divides by the largest of the four components (Shepperd 1978).
[[nodiscard]] inline PlumbQuat quaternion_of(const Matrix3& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  PlumbQuat q{};
  if (trace >= r[0][0] && trace >= r[1][1] && trace >= r[2][2]) {
    q = {r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1], 1 + trace};
  } else if (r[0][0] >= r[1][1] && r[0][0] >= r[2][2]) {
    q = {1 + 2 * r[0][0] - trace, r[0][1] + r[1][0], r[0][2] + r[2][0], r[2][1] - r[1][2]};
  } else if (r[1][1] >= r[2][2]) {
    q = {r[0][1] + r[1][0], 1 + 2 * r[1][1] - trace, r[1][2] + r[2][1], r[0][2] - r[2][0]};
  } else {
    q = {r[0][2] + r[2][0], r[1][2] + r[2][1], 1 + 2 * r[2][2] - trace, r[1][0] - r[0][1]};
  }
  const double n = (q.w < 0 ? -1 : 1) / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return {n * q.x, n * q.y, n * q.z, n * q.w};
}

}  // namespace plumb::backend
