#include "joints/generic_joint.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb::ode {
namespace {

/// A row on a velocity: of b's frame seen from a's, m/s.
struct Drive {
  double speed = 0;
  double bound = 0;     ///< N; 0: no row
  double softness = 0;  ///< s/kg
};

/// Where the coordinates x and z of a rotation run into each other (y is 90 degrees) their rows keep at least this
/// much.
constexpr double least_cosine = 0.05;
/// A contact's normal row that nothing reaches, m/s.
constexpr double never = -1e9;

PlumbVec3 axis_of(const PlumbPose& frame, std::size_t axis) {
  return rotate(frame.orientation, {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0});
}

void put(const PlumbVec3& v, dReal* at) {
  at[0] = v.x;
  at[1] = v.y;
  at[2] = v.z;
}

Drive drive_of(const Joint& joint, std::size_t axis, double at, const RowMaker& rows) {
  const PlumbSpring& spring = joint.desc.springs[axis];
  const PlumbMotor& motor = joint.desc.motors[axis];
  if (joint.desc.axis_modes[axis] == PLUMB_AXIS_LOCKED)
    return {-rows.settings.erp / rows.h * at, dInfinity, rows.settings.cfm};
  if (spring.enabled != 0) {
    const SoftRow soft = soft_row(spring, joint.spring_mass[axis], rows.h);
    return {soft.erp / rows.h * (spring.rest - at), dInfinity, soft.cfm};
  }
  if (motor.enabled != 0) return {motor.target_velocity, motor.max_force, rows.settings.cfm};
  return {};
}

/// Two drives along axes `first` and the one that follows it among x y z.
void add_drives(Joint& joint, const RowMaker& rows, std::size_t first, const Drive& one, const Drive& two) {
  if (one.bound == 0 && two.bound == 0) return;
  const PlumbPose frame = joint.frame_a();
  const double sign = joint.swapped() ? -1 : 1;
  dContact contact{};
  contact.surface.mode =
      dContactMu2 | dContactFDir1 | dContactMotion1 | dContactMotion2 | dContactMotionN | dContactSlip1 | dContactSlip2;
  contact.surface.mu = one.bound;
  contact.surface.mu2 = two.bound;
  contact.surface.motion1 = sign * one.speed;
  contact.surface.motion2 = sign * two.speed;
  contact.surface.motionN = never;
  contact.surface.slip1 = one.softness;
  contact.surface.slip2 = two.softness;
  // ODE's second direction is normal x first.
  put(axis_of(frame, first), contact.fdir1);
  put(axis_of(frame, (first + 2) % 3), contact.geom.normal);
  rows.add(joint, contact);
}

void add_limit(Joint& joint, const RowMaker& rows, std::size_t axis, double at) {
  const PlumbLimit& limit = joint.desc.limits[axis];
  if (joint.desc.axis_modes[axis] != PLUMB_AXIS_LIMITED || (at > limit.lower && at < limit.upper)) return;
  const bool low = at <= limit.lower;
  const double up = low == joint.swapped() ? -1 : 1;
  rows.add_push(joint, scale(up, axis_of(joint.frame_a(), axis)), low ? limit.lower - at : at - limit.upper);
}

/// The angular motor's row of one turning coordinate. axis: unit, along which the coordinate grows by 1 / stretch.
void set_turning(const Joint& joint, const RowMaker& rows, std::size_t axis, const PlumbVec3& direction, double at,
                 double stretch) {
  const PlumbMotor& motor = joint.desc.motors[axis];
  const PlumbSpring& spring = joint.desc.springs[axis];
  SoftRow soft{rows.settings.erp, rows.settings.cfm};
  double lower = -dInfinity, upper = dInfinity;
  if (joint.desc.axis_modes[axis] == PLUMB_AXIS_LOCKED) {
    lower = upper = 0;
  } else if (spring.enabled != 0) {
    soft = soft_row(spring, joint.spring_mass[axis], rows.h);
    lower = upper = stretch * spring.rest;
  } else if (joint.desc.axis_modes[axis] == PLUMB_AXIS_LIMITED) {
    lower = stretch * joint.desc.limits[axis].lower;
    upper = stretch * joint.desc.limits[axis].upper;
  }
  double angle = stretch * at, velocity = stretch * motor.target_velocity;
  if (joint.swapped()) {
    angle = -angle;
    velocity = -velocity;
    lower = std::exchange(upper, -lower);
    lower = -lower;
  }
  const int number = static_cast<int>(axis) - 3;
  const auto tell = [&](int parameter, double value) {
    dJointSetAMotorParam(joint.id, parameter + dParamGroup * number, value);
  };
  dJointSetAMotorAxis(joint.id, number, 0, direction.x, direction.y, direction.z);
  dJointSetAMotorAngle(joint.id, number, angle);
  tell(dParamLoStop, lower);
  tell(dParamHiStop, upper);
  tell(dParamStopERP, soft.erp);
  tell(dParamStopCFM, soft.cfm);
  tell(dParamCFM, rows.settings.cfm);
  tell(dParamVel, velocity);
  tell(dParamFMax, motor.enabled != 0 ? motor.max_force / stretch : 0);
}

}  // namespace

void prepare_motor(Joint& joint) {
  dJointSetAMotorMode(joint.id, dAMotorUser);
  dJointSetAMotorNumAxes(joint.id, 3);
}

void prepare_generic(Joint& joint, const RowMaker& rows) {
  double at[6];
  read_coordinates(joint, at);
  Drive drives[3];
  for (std::size_t axis = 0; axis < 3; ++axis) drives[axis] = drive_of(joint, axis, at[axis], rows);
  add_drives(joint, rows, 0, drives[0], drives[1]);
  add_drives(joint, rows, 2, drives[2], {});
  for (std::size_t axis = 0; axis < 3; ++axis) add_limit(joint, rows, axis, at[axis]);
  // The turns are about x of a, z of b, and y square to both. A coordinate grows along what is square to the axes of
  // the other two.
  const PlumbVec3 x = axis_of(joint.frame_a(), 0), z = axis_of(joint.frame_b(), 2), across = cross(z, x);
  const double cosine = std::max(length(across), least_cosine);
  const PlumbVec3 y = length(across) > 0 ? scale(1 / length(across), across) : axis_of(joint.frame_b(), 1);
  set_turning(joint, rows, 3, cross(y, z), at[3], cosine);
  set_turning(joint, rows, 4, y, at[4], 1);
  set_turning(joint, rows, 5, cross(x, y), at[5], cosine);
}

}  // namespace plumb::ode
