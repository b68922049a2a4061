// Bullet's headers that everything here needs, and the way between its vectors and those of the wall.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <limits>
#include <string>

#include "plumb/physics_world.hpp"

namespace plumb::bullet {

/// Numbers whose squares Bullet can still hold.
inline constexpr double kLargest = sizeof(btScalar) == 4 ? 1e18 : 1e150;
/// Lengths, masses and inertias whose inverses it can still hold.
inline constexpr double kSmallest = sizeof(btScalar) == 4 ? 1e-12 : 1e-75;

/// A number for Bullet; refuses what would overflow inside it.
inline btScalar scalar(double value, const char* what) {
  if (std::abs(value) > kLargest)
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string(what) + " is " + std::to_string(value) +
                                              ", too large for the arithmetic of this build of Bullet");
  return static_cast<btScalar>(value);
}

/// Likewise for a number above 0 whose inverse is needed.
inline btScalar positive_scalar(double value, const char* what) {
  if (value < kSmallest)
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::string(what) + " is below " + std::to_string(kSmallest) +
                                              ", too small for the arithmetic of this build of Bullet");
  return scalar(value, what);
}

inline btVector3 vector(const PlumbVec3& v, const char* what) {
  return {scalar(v.x, what), scalar(v.y, what), scalar(v.z, what)};
}
inline btVector3 vector(const double* v, const char* what) { return vector(PlumbVec3{v[0], v[1], v[2]}, what); }
inline btQuaternion quaternion(const PlumbQuat& q) {
  return {static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
          static_cast<btScalar>(q.w)};
}
inline btTransform transform(const PlumbPose& pose, const char* what) {
  return btTransform(quaternion(pose.orientation), vector(pose.position, what));
}

inline PlumbVec3 to_plumb(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline void put_vector(const btVector3& v, double* row) {
  row[0] = v.x();
  row[1] = v.y();
  row[2] = v.z();
}

inline void put_pose(const btTransform& transform, double* row) {
  btQuaternion q;
  transform.getBasis().getRotation(q);
  put_vector(transform.getOrigin(), row);
  row[3] = q.x();
  row[4] = q.y();
  row[5] = q.z();
  row[6] = q.w();
}

inline PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }

}  // namespace plumb::bullet
