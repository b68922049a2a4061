// libsdformat's vectors and poses as the harness's.
#pragma once

#include <fmt/format.h>

#include <ignition/math/Matrix3.hh>
#include <ignition/math/Pose3.hh>
#include <sdf/Types.hh>
#include <string>

#include "base/usage_error.hpp"
#include "referee/pose.hpp"

namespace plumb::harness {

[[nodiscard]] inline referee::Vec3 vec_of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

[[nodiscard]] inline referee::Pose pose_of(const ignition::math::Pose3d& pose) {
  const auto& q = pose.Rot();
  return {referee::Quat(q.W(), q.X(), q.Y(), q.Z()).normalized().toRotationMatrix(), vec_of(pose.Pos())};
}

[[nodiscard]] inline referee::Mat3 matrix_of(const ignition::math::Matrix3d& m) {
  referee::Mat3 matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      matrix(row, column) = m(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
  return matrix;
}

/// Throws UsageError with the first of libsdformat's errors.
inline void check_sdf(const std::string& what, const sdf::Errors& errors) {
  if (!errors.empty()) throw UsageError(fmt::format("{}: {}", what, errors.front().Message()));
}

}  // namespace plumb::harness
