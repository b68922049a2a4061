#include "referee/joints.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::referee {

namespace {

// Frame b seen from frame a.
Pose relative_frame(const PlumbJointDesc& joint, const Pose& body_a, const Pose& body_b) {
  return (body_b * pose(joint.frame_b)).seen_from(body_a * pose(joint.frame_a));
}

std::array<double, 6> coordinates_of(const Pose& relative) {
  const Mat3& r = relative.rotation;
  const Vec3& t = relative.position;
  return {t.x(),
          t.y(),
          t.z(),
          std::atan2(-r(1, 2), r(2, 2)),
          std::atan2(r(0, 2), std::hypot(r(1, 2), r(2, 2))),
          std::atan2(-r(0, 1), r(0, 0))};
}

double whole_angle(const Mat3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return 2 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

double beyond(const PlumbLimit& limit, double value) {
  return limit.enabled != 0 ? std::max({0.0, limit.lower - value, value - limit.upper}) : 0;
}

}  // namespace

std::array<double, 6> joint_coordinates(const PlumbJointDesc& joint, const Pose& body_a, const Pose& body_b) {
  return coordinates_of(relative_frame(joint, body_a, body_b));
}

JointError joint_error(const PlumbJointDesc& joint, const Pose& body_a, const Pose& body_b) {
  const Pose relative = relative_frame(joint, body_a, body_b);
  const Mat3& r = relative.rotation;
  const Vec3& gap = relative.position;
  std::array<double, 6> at = coordinates_of(relative);
  JointError error;
  std::array<bool, 6> limited{};
  switch (joint.type) {
    case PLUMB_JOINT_BALL:
      error.position = gap.norm();
      limited = {false, false, false, true, true, true};
      break;
    case PLUMB_JOINT_HINGE:
      error.position = gap.norm();
      error.angle = angle_between(Vec3::UnitX(), r.col(0));
      at[3] = std::atan2(r(2, 1) - r(1, 2), r(1, 1) + r(2, 2));  // turn about x, whatever the axes' small misalignment
      limited[3] = true;
      break;
    case PLUMB_JOINT_SLIDER:
      error.position = std::hypot(gap.y(), gap.z());
      error.angle = whole_angle(r);
      limited[0] = true;
      break;
    case PLUMB_JOINT_DISTANCE:
      at[0] = gap.norm();
      limited[0] = true;
      if (joint.limits[0].enabled == 0 && joint.springs[0].enabled == 0)
        error.position = std::abs(at[0] - joint.rest_length);
      break;
    case PLUMB_JOINT_FIXED:
      error.position = gap.norm();
      error.angle = whole_angle(r);
      break;
    case PLUMB_JOINT_UNIVERSAL:
      error.position = gap.norm();
      error.angle = std::abs(std::asin(std::clamp(r(0, 1), -1.0, 1.0)));  // a's x . b's y
      limited[3] = limited[4] = true;
      break;
    case PLUMB_JOINT_GENERIC: {
      const auto locked = [&](std::size_t axis) { return joint.axis_modes[axis] == PLUMB_AXIS_LOCKED; };
      double squares = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (locked(axis)) squares += at[axis] * at[axis];
      error.position = std::sqrt(squares);
      for (std::size_t axis = 3; axis < 6; ++axis)
        if (locked(axis)) error.angle = std::max(error.angle, std::abs(at[axis]));
      if (locked(3) && locked(4) && locked(5)) error.angle = whole_angle(r);
      for (std::size_t axis = 0; axis < 6; ++axis) limited[axis] = joint.axis_modes[axis] == PLUMB_AXIS_LIMITED;
      break;
    }
    default: break;
  }
  for (std::size_t axis = 0; axis < 6; ++axis) {
    if (!limited[axis]) continue;
    double& worst = axis < 3 ? error.limit_position : error.limit_angle;
    PlumbLimit limit = joint.limits[axis];
    if (joint.type == PLUMB_JOINT_GENERIC) limit.enabled = 1;
    worst = std::max(worst, beyond(limit, at[axis]));
  }
  return error;
}

}  // namespace plumb::referee
