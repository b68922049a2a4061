// 3 by 3 matrices: rotations as columns, and symmetric ones (inertia, effective mass).
#pragma once

#include "math/quat.hpp"

namespace plumb::impulse {

/// Columns. For a rotation, column i is the image of axis i.
template <class N>
struct Mat33 {
  Vec3<N> x, y, z;

  PLUMB_HD constexpr const Vec3<N>& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};
using Mat = Mat33<Real>;

template <class N>
PLUMB_HD constexpr Vec3<N> operator*(const Mat33<N>& m, const Vec3<N>& v) {
  return v.x * m.x + v.y * m.y + v.z * m.z;
}
/// transpose(m) v
template <class N>
PLUMB_HD constexpr Vec3<N> multiply_transposed(const Mat33<N>& m, const Vec3<N>& v) {
  return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}
template <class N>
PLUMB_HD constexpr Mat33<N> operator*(const Mat33<N>& a, const Mat33<N>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
template <class N>
PLUMB_HD constexpr Mat33<N> to_matrix(const Quat4<N>& q) {
  const N x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const N xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
  const N xy = q.x * y2, xz = q.x * z2, yz = q.y * z2, wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  const N one = N(1);
  return {{one - yy - zz, xy + wz, xz - wy}, {xy - wz, one - xx - zz, yz + wx}, {xz + wy, yz - wx, one - xx - yy}};
}

/// Symmetric.
template <class N>
struct Sym33 {
  N xx, yy, zz, xy, xz, yz;
};
using Sym = Sym33<Real>;

template <class N>
PLUMB_HD constexpr Vec3<N> operator*(const Sym33<N>& s, const Vec3<N>& v) {
  return {s.xx * v.x + s.xy * v.y + s.xz * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
          s.xz * v.x + s.yz * v.y + s.zz * v.z};
}
template <class N>
PLUMB_HD constexpr Sym33<N> operator+(const Sym33<N>& a, const Sym33<N>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}
template <class N>
PLUMB_HD constexpr Sym33<N> operator*(const N& k, const Sym33<N>& a) {
  return {k * a.xx, k * a.yy, k * a.zz, k * a.xy, k * a.xz, k * a.yz};
}
/// R diag(d) R^T
template <class N>
PLUMB_HD constexpr Sym33<N> rotated_diagonal(const Mat33<N>& r, const Vec3<N>& d) {
  return {d.x * r.x.x * r.x.x + d.y * r.y.x * r.y.x + d.z * r.z.x * r.z.x,
          d.x * r.x.y * r.x.y + d.y * r.y.y * r.y.y + d.z * r.z.y * r.z.y,
          d.x * r.x.z * r.x.z + d.y * r.y.z * r.y.z + d.z * r.z.z * r.z.z,
          d.x * r.x.x * r.x.y + d.y * r.y.x * r.y.y + d.z * r.z.x * r.z.y,
          d.x * r.x.x * r.x.z + d.y * r.y.x * r.y.z + d.z * r.z.x * r.z.z,
          d.x * r.x.y * r.x.z + d.y * r.y.y * r.y.z + d.z * r.z.y * r.z.z};
}

}  // namespace plumb::impulse
