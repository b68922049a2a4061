// Gazebo's vectors and poses as Plumb's, and back.
#pragma once

#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

#include "plumb/types.h"

namespace plumb::gazebo {

using Vector = ignition::math::Vector3d;
using Rotation = ignition::math::Quaterniond;
using Placement = ignition::math::Pose3d;

[[nodiscard]] inline PlumbVec3 to_plumb(const Vector& v) { return {v.X(), v.Y(), v.Z()}; }
[[nodiscard]] inline PlumbQuat to_plumb(const Rotation& given) {
  const Rotation q = given.Normalized();
  return {q.X(), q.Y(), q.Z(), q.W()};
}
[[nodiscard]] inline PlumbPose to_plumb(const Placement& pose) { return {to_plumb(pose.Pos()), to_plumb(pose.Rot())}; }

[[nodiscard]] inline Vector from_plumb(const PlumbVec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline Placement from_plumb(const PlumbPose& pose) {
  const PlumbQuat& q = pose.orientation;
  return {from_plumb(pose.position), Rotation(q.w, q.x, q.y, q.z)};
}

[[nodiscard]] inline Placement turned(const Rotation& rotation) { return {Vector::Zero, rotation}; }

}  // namespace plumb::gazebo
