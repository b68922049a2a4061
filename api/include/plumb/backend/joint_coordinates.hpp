// The six coordinates of a joint, for engines that tell none or others.
#pragma once

#include <algorithm>

#include "plumb/backend/small_math.hpp"
#include "plumb/joints.h"

namespace plumb::backend {

/// Turns about x, then y, then z of the turned frame, rad: those of R = Rx Ry Rz. Near y = +-pi/2 the other two are not
/// told apart, and only their sum or difference means something.
[[nodiscard]] inline PlumbVec3 angles_xyz(const Matrix3& r) {
  return {std::atan2(-r[1][2], r[2][2]), std::asin(std::clamp(r[0][2], -1.0, 1.0)), std::atan2(-r[0][1], r[0][0])};
}

/// The twist about x, then the swing's y and z: of PLUMB_JOINT_SWING_TWIST. Where the x axes are opposite, the twist is
/// taken as 0.
[[nodiscard]] inline PlumbVec3 swing_twist(const PlumbQuat& turn) {
  const double side = turn.w < 0 ? -1 : 1, w = side * turn.w, x = side * turn.x;
  const double c = std::hypot(w, x);                                  // the cosine of half the swing
  const double cosine = c > 0 ? w / c : 1, sine = c > 0 ? x / c : 0;  // of half the twist
  const double y = side * (cosine * turn.y - sine * turn.z), z = side * (cosine * turn.z + sine * turn.y);
  const double s = std::hypot(y, z), share = s > 0 ? 2 * std::atan2(s, c) / s : 2;
  return {2 * std::atan2(sine, cosine), share * y, share * z};
}

/// The turn of which swing_twist tells these numbers.
[[nodiscard]] inline PlumbQuat turn_of_swing_twist(const PlumbVec3& turns) {
  const double angle = std::hypot(turns.y, turns.z), share = angle > 0 ? std::sin(angle / 2) / angle : 0.5;
  const PlumbQuat swing{0, share * turns.y, share * turns.z, std::cos(angle / 2)};
  return multiply(swing, {std::sin(turns.x / 2), 0, 0, std::cos(turns.x / 2)});
}

/// PLUMB_JOINT_COORDINATES of every type of joint, out of its two frames in world axes: b's origin and turn as seen
/// from a, m and rad. row has 6 numbers.
inline void joint_coordinates(PlumbJointType type, const PlumbPose& frame_a, const PlumbPose& frame_b, double* row) {
  const PlumbPose seen = compose(inverse(frame_a), frame_b);
  const PlumbVec3 turn =
      type == PLUMB_JOINT_SWING_TWIST ? swing_twist(seen.orientation) : angles_xyz(rotation_matrix(seen.orientation));
  const double all[6] = {seen.position.x, seen.position.y, seen.position.z, turn.x, turn.y, turn.z};
  std::copy(all, all + 6, row);
}

}  // namespace plumb::backend
