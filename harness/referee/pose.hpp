// Eigen types of the referee, and poses. Everything here computes in float64.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "plumb/types.h"

namespace plumb::referee {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

[[nodiscard]] inline Vec3 vec(const PlumbVec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline PlumbVec3 plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
/// Normalized.
[[nodiscard]] inline Quat quat(const PlumbQuat& q) { return Quat(q.w, q.x, q.y, q.z).normalized(); }

/// A rigid placement: p of the local frame is at rotation * p + position.
struct Pose {
  Mat3 rotation = Mat3::Identity();
  Vec3 position = Vec3::Zero();

  [[nodiscard]] Vec3 operator*(const Vec3& p) const { return rotation * p + position; }
  [[nodiscard]] Pose operator*(const Pose& inner) const {
    return {rotation * inner.rotation, rotation * inner.position + position};
  }
  [[nodiscard]] Pose inverse() const { return {rotation.transpose(), -(rotation.transpose() * position)}; }
  /// This pose seen from another: positions are subtracted first, so nothing is lost far from the origin.
  [[nodiscard]] Pose seen_from(const Pose& frame) const {
    return {frame.rotation.transpose() * rotation, frame.rotation.transpose() * (position - frame.position)};
  }
};

[[nodiscard]] inline Pose pose(const PlumbVec3& position, const PlumbQuat& orientation) {
  return {quat(orientation).toRotationMatrix(), vec(position)};
}
[[nodiscard]] inline Pose pose(const PlumbPose& p) { return pose(p.position, p.orientation); }

}  // namespace plumb::referee
