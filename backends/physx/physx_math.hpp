// Values of the wall as PhysX's and back. PhysX calculates in float. Its names begin with Px.
#pragma once

#include <PxPhysicsAPI.h>

#include <cmath>
#include <limits>

#include "plumb/backend/checks.hpp"
#include "plumb/backend/small_math.hpp"

namespace plumb::px {

using namespace ::physx;

/// Throws Error (PLUMB_E_INVALID_ARGUMENT) for what float cannot hold; name: of the argument.
inline float scalar(double value, const char* name) {
  if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string(name) + " is " + backend::number_text(value) +
                                              ", beyond PhysX's single precision; use smaller numbers");
  return static_cast<float>(value);
}
inline PxVec3 vector(const PlumbVec3& v, const char* name) {
  return {scalar(v.x, name), scalar(v.y, name), scalar(v.z, name)};
}
inline PxVec3 vector(const double* v, const char* name) { return vector(PlumbVec3{v[0], v[1], v[2]}, name); }
inline PxQuat quaternion(const PlumbQuat& q) {
  const PlumbQuat unit = backend::normalized(q);
  return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z),
          static_cast<float>(unit.w)};
}
inline PxTransform transform(const PlumbPose& pose, const char* name) {
  return {vector(pose.position, name), quaternion(pose.orientation)};
}

inline PlumbVec3 to_plumb(const PxVec3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline PlumbPose to_plumb(const PxTransform& pose) {
  return {to_plumb(pose.p),
          {static_cast<double>(pose.q.x), static_cast<double>(pose.q.y), static_cast<double>(pose.q.z),
           static_cast<double>(pose.q.w)}};
}
inline PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }

/// PhysX's capsules and cylinders lie along x, and so do the normals of its planes; ours along y.
inline PxQuat along_y() { return PxQuat(PxHalfPi, PxVec3(0, 0, 1)); }

}  // namespace plumb::px
