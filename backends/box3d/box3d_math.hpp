// Values of the wall as Box3D's and back. Box3D calculates in float, with positions in double where it was built so.
#pragma once

#include <box3d/box3d.h>

#include <cmath>
#include <limits>

#include "plumb/backend/checks.hpp"
#include "plumb/backend/small_math.hpp"

namespace plumb::box3d {

/// Throws Error (PLUMB_E_INVALID_ARGUMENT) for what float cannot hold; name: of the argument.
inline float scalar(double value, const char* name) {
  if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string(name) + " is " + backend::number_text(value) +
                                              ", beyond Box3D's single precision; use smaller numbers");
  return static_cast<float>(value);
}
inline b3Vec3 vector(const PlumbVec3& v, const char* name) {
  return {scalar(v.x, name), scalar(v.y, name), scalar(v.z, name)};
}
inline b3Vec3 vector(const double* v, const char* name) { return vector(PlumbVec3{v[0], v[1], v[2]}, name); }
inline b3Pos position(const PlumbVec3& v, const char* name) {
  const b3Vec3 checked = vector(v, name);
  b3Pos at = b3Pos_zero;
  if constexpr (sizeof(at.x) == sizeof(double)) {
    at.x = static_cast<decltype(at.x)>(v.x), at.y = static_cast<decltype(at.y)>(v.y),
    at.z = static_cast<decltype(at.z)>(v.z);
  } else {
    at.x = checked.x, at.y = checked.y, at.z = checked.z;
  }
  return at;
}
inline b3Quat quaternion(const PlumbQuat& q) {
  const PlumbQuat unit = backend::normalized(q);
  return {{static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z)},
          static_cast<float>(unit.w)};
}
inline b3Transform transform(const PlumbPose& pose, const char* name) {
  return {vector(pose.position, name), quaternion(pose.orientation)};
}

/// A b3Vec3 or a b3Pos.
template <class Vector>
PlumbVec3 to_plumb(const Vector& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline PlumbQuat to_plumb(const b3Quat& q) {
  return {static_cast<double>(q.v.x), static_cast<double>(q.v.y), static_cast<double>(q.v.z), static_cast<double>(q.s)};
}
inline PlumbPose pose_of(const b3WorldTransform& at) { return {to_plumb(at.p), to_plumb(at.q)}; }
inline PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }

}  // namespace plumb::box3d
