// Vectors and poses of gz-physics, which are Eigen's, as those of ignition::math, and back.
#pragma once

#include <Eigen/Geometry>
#include <ignition/math/eigen3/Conversions.hh>

#include "hosts/gazebo/world/transform.hpp"

namespace plumb::gazebo {

[[nodiscard]] inline Eigen::Vector3d to_eigen(const Vector& v) { return {v.X(), v.Y(), v.Z()}; }
[[nodiscard]] inline Eigen::Isometry3d to_eigen(const Placement& pose) { return ignition::math::eigen3::convert(pose); }
[[nodiscard]] inline Vector from_eigen(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
[[nodiscard]] inline Placement from_eigen(const Eigen::Isometry3d& pose) {
  return ignition::math::eigen3::convert(pose);
}

}  // namespace plumb::gazebo
