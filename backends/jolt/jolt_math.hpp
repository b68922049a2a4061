// Values of the wall as Jolt's and back. Jolt calculates in float, with positions in double where it was built so.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Body/Body.h>

#include <cmath>
#include <limits>

#include "plumb/backend/checks.hpp"
#include "plumb/backend/small_math.hpp"

namespace plumb::jolt {

/// Throws Error (PLUMB_E_INVALID_ARGUMENT) for what float cannot hold; name: of the argument.
inline float scalar(double value, const char* name) {
  if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string(name) + " is " + backend::number_text(value) +
                                              ", beyond Jolt's single precision; use smaller numbers");
  return static_cast<float>(value);
}
inline JPH::Vec3 vector(const PlumbVec3& v, const char* name) {
  return {scalar(v.x, name), scalar(v.y, name), scalar(v.z, name)};
}
inline JPH::Vec3 vector(const double* v, const char* name) { return vector(PlumbVec3{v[0], v[1], v[2]}, name); }
inline JPH::RVec3 position(const PlumbVec3& v, const char* name) {
  (void)vector(v, name);
  return {static_cast<JPH::Real>(v.x), static_cast<JPH::Real>(v.y), static_cast<JPH::Real>(v.z)};
}
inline JPH::Quat quaternion(const PlumbQuat& q) {
  const PlumbQuat unit = backend::normalized(q);
  return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z),
          static_cast<float>(unit.w)};
}
inline JPH::Mat44 transform(const PlumbPose& pose, const char* name) {
  return JPH::Mat44::sRotationTranslation(quaternion(pose.orientation), vector(pose.position, name));
}

inline PlumbVec3 to_plumb(JPH::Vec3Arg v) {
  return {static_cast<double>(v.GetX()), static_cast<double>(v.GetY()), static_cast<double>(v.GetZ())};
}
#ifdef JPH_DOUBLE_PRECISION
inline PlumbVec3 to_plumb(JPH::DVec3Arg v) { return {v.GetX(), v.GetY(), v.GetZ()}; }
#endif
inline PlumbQuat to_plumb(JPH::QuatArg q) {
  return {static_cast<double>(q.GetX()), static_cast<double>(q.GetY()), static_cast<double>(q.GetZ()),
          static_cast<double>(q.GetW())};
}
/// Of the body's frame: Jolt keeps that of the centre of mass.
inline PlumbPose pose_of(const JPH::Body& body) { return {to_plumb(body.GetPosition()), to_plumb(body.GetRotation())}; }
inline PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }

}  // namespace plumb::jolt
