// The six coordinates of a joint, for engines that tell none or others.
#pragma once

#include <algorithm>

#include "plumb/backend/small_math.hpp"

namespace plumb::backend {

/// Turns about x, then y, then z of the turned frame, rad: those of R = Rx Ry Rz. Near y = +-pi/2 the other two are not
/// told apart, and only their sum or difference means something.
[[nodiscard]] inline PlumbVec3 angles_xyz(const Matrix3& r) {
  return {std::atan2(-r[1][2], r[2][2]), std::asin(std::clamp(r[0][2], -1.0, 1.0)), std::atan2(-r[0][1], r[0][0])};
}

/// PLUMB_JOINT_COORDINATES of every type of joint, out of its two frames in world axes: b's origin and turn as seen
/// from a, m and rad. row has 6 numbers.
inline void joint_coordinates(const PlumbPose& frame_a, const PlumbPose& frame_b, double* row) {
  const PlumbPose seen = compose(inverse(frame_a), frame_b);
  const PlumbVec3 turn = angles_xyz(rotation_matrix(seen.orientation));
  const double all[6] = {seen.position.x, seen.position.y, seen.position.z, turn.x, turn.y, turn.z};
  std::copy(all, all + 6, row);
}

}  // namespace plumb::backend
