// Values of the wall as Eigen's, in which DART computes, and back.
#pragma once

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "plumb/backend/small_math.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::dart6 {

using backend::add;
using backend::compose;
using backend::cross;
using backend::dot;
using backend::inverse;
using backend::length;
using backend::multiply;
using backend::normalized;
using backend::rotate;
using backend::scale;
using backend::sub;
using backend::unrotate;

inline Eigen::Vector3d eigen(const PlumbVec3& v) { return {v.x, v.y, v.z}; }
inline Eigen::Matrix3d eigen(const PlumbQuat& q) { return Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix(); }
inline Eigen::Isometry3d eigen(const PlumbPose& pose) {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.translation() = eigen(pose.position);
  out.linear() = eigen(normalized(pose.orientation));
  return out;
}
inline PlumbVec3 vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline PlumbPose pose_of(const Eigen::Isometry3d& t) {
  const Eigen::Quaterniond q(Eigen::Matrix3d(t.linear()));
  return {vec(t.translation()), normalized(PlumbQuat{q.x(), q.y(), q.z(), q.w()})};
}
inline PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }
inline void put(const PlumbVec3& v, double* to) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}
inline PlumbVec3 point_of(const PlumbPose& pose, const PlumbVec3& local) {
  return add(pose.position, rotate(pose.orientation, local));
}
/// Unit vector along x, y or z.
constexpr PlumbVec3 unit(std::size_t axis) { return {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0}; }

/// DART's capsules and cylinders stand along z, ours along y.
inline constexpr PlumbQuat kZToY{-0.70710678118654752440, 0, 0, 0.70710678118654752440};

}  // namespace plumb::dart6
