#include "referee/joints.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::referee {

namespace {

// Frame b seen from frame a.
Pose relative_frame(const PlumbJointDesc& joint, const Pose& body_a, const Pose& body_b) {
  return (body_b * pose(joint.frame_b)).seen_from(body_a * pose(joint.frame_a));
}

double whole_angle(const Mat3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return 2 * std::atan2(q.vec().norm(), std::abs(q.w()));
}

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// Turns about x, y and z that the joint does not lock, as bits.
unsigned free_turns(const PlumbJointDesc& joint) {
  constexpr unsigned x = 1, y = 2, all = 7;
  switch (joint.type) {
    case PLUMB_JOINT_HINGE: return x;
    case PLUMB_JOINT_UNIVERSAL: return x | y;
    case PLUMB_JOINT_GENERIC: {
      unsigned free = 0;
      for (std::size_t i = 0; i < 3; ++i)
        if (joint.axis_modes[3 + i] != PLUMB_AXIS_LOCKED) free |= 1U << i;
      return free;
    }
    default: return all;
  }
}

/// R = Rx Ry Rz. Where one or two of the turns are locked, the others are measured between axes that the locks keep
/// square, which knows no singular place, and what is locked by how far they are from that.
Vec3 turns_of(const Mat3& r, unsigned free) {
  const auto sine = [](double x) { return std::asin(std::clamp(x, -1.0, 1.0)); };
  const auto about = [&](int i, int j, int k) {
    Vec3 turns = Vec3::Zero();
    turns[i] = std::atan2(r(k, j) - r(j, k), r(j, j) + r(k, k));
    turns[j] = angle_between(Vec3::Unit(i), r.col(i));  // of the two locked ones together
    return turns;
  };
  switch (free) {
    case 0b001: return about(0, 1, 2);
    case 0b010: return about(1, 2, 0);
    case 0b100: return about(2, 0, 1);
    case 0b011: return {std::atan2(r(2, 1), r(1, 1)), std::atan2(r(0, 2), r(0, 0)), sine(-r(0, 1))};
    case 0b101: return {std::atan2(-r(1, 2), r(2, 2)), sine(r(0, 2)), std::atan2(-r(0, 1), r(0, 0))};
    case 0b110: return {sine(-r(1, 2)), std::atan2(r(0, 2), r(2, 2)), std::atan2(r(1, 0), r(1, 1))};
    default:
      return {std::atan2(-r(1, 2), r(2, 2)), std::atan2(r(0, 2), std::hypot(r(1, 2), r(2, 2))),
              std::atan2(-r(0, 1), r(0, 0))};
  }
}

/// R = swing twist: the twist about x, then the y and z of the swing's vector.
Vec3 swing_twist_of(const Mat3& r) {
  const Vec3 across = Vec3::UnitX().cross(r.col(0));
  const double angle = angle_between(Vec3::UnitX(), r.col(0));
  const Vec3 about = across.norm() > 0 ? across.normalized() : Vec3::UnitY();
  const Mat3 twist = Eigen::AngleAxisd(-angle, about).toRotationMatrix() * r;
  return {std::atan2(twist(2, 1), twist(1, 1)), angle * about.y(), angle * about.z()};
}

/// How far b's x axis is beyond the cone, along its meridian, rad.
double beyond_cone(double half_y, double half_z, double y, double z) {
  const double angle = std::hypot(y, z);
  return angle > 0 ? std::max(0.0, angle - angle / std::hypot(y / half_y, z / half_z)) : 0;
}

std::array<double, 6> coordinates_of(const PlumbJointDesc& joint, const Pose& relative) {
  const Vec3 turns = joint.type == PLUMB_JOINT_SWING_TWIST ? swing_twist_of(relative.rotation)
                                                           : turns_of(relative.rotation, free_turns(joint));
  const Vec3& t = relative.position;
  return {t.x(), t.y(), t.z(), turns.x(), turns.y(), turns.z()};
}

double beyond(const PlumbLimit& limit, double value) {
  return limit.enabled != 0 ? std::max({0.0, limit.lower - value, value - limit.upper}) : 0;
}

/// Poses do not tell how often it has gone round: robots' limits lie beyond a half turn.
double turned_beyond(const PlumbLimit& limit, double angle) {
  constexpr double turn = 2 * std::numbers::pi;
  return std::min({beyond(limit, angle - turn), beyond(limit, angle), beyond(limit, angle + turn)});
}

}  // namespace

std::array<double, 6> joint_coordinates(const PlumbJointDesc& joint, const Pose& body_a, const Pose& body_b) {
  return coordinates_of(joint, relative_frame(joint, body_a, body_b));
}

JointError joint_error(const PlumbJointDesc& joint, const Pose& body_a, const Pose& body_b) {
  const Pose relative = relative_frame(joint, body_a, body_b);
  const Mat3& r = relative.rotation;
  const Vec3& gap = relative.position;
  std::array<double, 6> at = coordinates_of(joint, relative);
  JointError error;
  std::array<bool, 6> limited{};
  switch (joint.type) {
    case PLUMB_JOINT_BALL:
      error.position = gap.norm();
      limited = {false, false, false, true, true, true};
      break;
    case PLUMB_JOINT_HINGE:
      error.position = gap.norm();
      error.angle = at[4];
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
      error.angle = std::abs(at[5]);
      limited[3] = limited[4] = true;
      break;
    case PLUMB_JOINT_SWING_TWIST:
      error.position = gap.norm();
      limited[3] = true;
      if (joint.limits[4].enabled != 0)
        error.limit_angle = beyond_cone(joint.limits[4].upper, joint.limits[5].upper, at[4], at[5]);
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
    PlumbLimit limit = joint.limits[axis];
    if (joint.type == PLUMB_JOINT_GENERIC) limit.enabled = 1;
    if (axis < 3)
      error.limit_position = std::max(error.limit_position, beyond(limit, at[axis]));
    else
      error.limit_angle = std::max(error.limit_angle, turned_beyond(limit, at[axis]));
  }
  return error;
}

}  // namespace plumb::referee
