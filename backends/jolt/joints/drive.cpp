// From a descriptor to constraints, and what drives them: motors and springs.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Constraints/DistanceConstraint.h>
#include <Jolt/Physics/Constraints/HingeConstraint.h>
#include <Jolt/Physics/Constraints/SliderConstraint.h>

#include <algorithm>

#include "joints/joint.hpp"
#include "plumb/backend/names.hpp"

namespace plumb::jolt {
namespace {

/// Jolt drives an axis by a spring or by a motor, and the turns of a ball that began without any by neither.
bool takes_motors_apart(const Joint& joint) {
  const PlumbJointDesc& desc = joint.desc;
  if (joint.main->GetSubType() == JPH::EConstraintSubType::Point) return takes_six_axes(desc);
  for (std::size_t axis = 0; axis < 6; ++axis)
    if (desc.motors[axis].enabled != 0 && desc.springs[axis].enabled != 0) return true;
  return false;
}

bool springs_beside_limits(const PlumbJointDesc& desc) {
  return desc.type == PLUMB_JOINT_DISTANCE && desc.limits[0].enabled != 0 && desc.springs[0].enabled != 0;
}

JPH::EMotorState state_of(const PlumbJointDesc& desc, std::size_t axis, bool motors) {
  if (desc.springs[axis].enabled != 0) return JPH::EMotorState::PositionAndVelocity;
  return motors && desc.motors[axis].enabled != 0 ? JPH::EMotorState::Velocity : JPH::EMotorState::Off;
}

/// Where a spring rests is clamped by Jolt to limits that it has: they come afterwards.
void drive_hinge(JPH::HingeConstraint& hinge, const PlumbJointDesc& desc, bool motors) {
  const PlumbMotor& motor = desc.motors[3];
  const JPH::EMotorState state = state_of(desc, 3, motors);
  const bool springs = state == JPH::EMotorState::PositionAndVelocity;
  if (springs) hinge.GetMotorSettings().mSpringSettings = spring_settings(desc.springs[3]);
  hinge.GetMotorSettings().SetTorqueLimit(springs ? FLT_MAX : number(motor.max_force));
  hinge.SetMotorState(state);
  hinge.SetTargetAngularVelocity(springs ? 0 : number(motor.target_velocity));
  hinge.SetLimits(-JPH::JPH_PI, JPH::JPH_PI);
  hinge.SetTargetAngle(number(desc.springs[3].rest - zero_of(desc.limits[3])));
  const AxisLimits limits = hinge_limits(desc);
  hinge.SetLimits(limits.lower, limits.upper);
}

void drive_slider(JPH::SliderConstraint& slider, const PlumbJointDesc& desc, bool motors) {
  const PlumbMotor& motor = desc.motors[0];
  const JPH::EMotorState state = state_of(desc, 0, motors);
  const bool springs = state == JPH::EMotorState::PositionAndVelocity;
  if (springs) slider.GetMotorSettings().mSpringSettings = spring_settings(desc.springs[0]);
  slider.GetMotorSettings().SetForceLimit(springs ? FLT_MAX : number(motor.max_force));
  slider.SetMotorState(state);
  slider.SetTargetVelocity(springs ? 0 : number(motor.target_velocity));
  slider.SetLimits(-FLT_MAX, FLT_MAX);
  slider.SetTargetPosition(number(desc.springs[0].rest - zero_of(desc.limits[0])));
  const AxisLimits limits = slider_limits(desc);
  slider.SetLimits(limits.lower, limits.upper);
}

void drive_distance(const Joint& joint) {
  const float rest = number(joint.desc.rest_length);
  const bool limited = joint.desc.limits[0].enabled != 0;
  JPH::TwoBodyConstraint* of_rest = limited ? joint.helper.GetPtr() : joint.main.GetPtr();
  if (of_rest != nullptr) static_cast<JPH::DistanceConstraint*>(of_rest)->SetDistance(rest, rest);
}

}  // namespace

void check_joint(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_DISTANCE && desc.motors[0].enabled != 0)
    throw Error(PLUMB_E_UNSUPPORTED, "Jolt's distance joints have no motors; take a slider");
}

bool make_helper(Joint& joint, const Ends& ends) {
  if (joint.helper != nullptr) return false;
  if (springs_beside_limits(joint.desc))
    joint.helper = make_distance_spring(joint.desc, ends);
  else if (takes_motors_apart(joint))
    joint.helper = make_free_axes(joint.desc, ends);
  return joint.helper != nullptr;
}

void make_constraints(Joint& joint, const Ends& ends) {
  const PlumbJointDesc& desc = joint.desc;
  joint.main = backend::is_meshing(desc.type) ? make_meshing(desc, ends)
               : takes_six_axes(desc)         ? make_six_axes(desc, ends)
                                              : make_axis_joint(desc, ends);
  make_helper(joint, ends);
  drive(joint);
}

void drive(const Joint& joint) {
  const PlumbJointDesc& desc = joint.desc;
  JPH::TwoBodyConstraint& main = *joint.main;
  if (desc.type == PLUMB_JOINT_DISTANCE) return drive_distance(joint);
  const bool motors = joint.helper == nullptr;
  switch (main.GetSubType()) {
    case JPH::EConstraintSubType::Hinge: drive_hinge(static_cast<JPH::HingeConstraint&>(main), desc, motors); break;
    case JPH::EConstraintSubType::Slider: drive_slider(static_cast<JPH::SliderConstraint&>(main), desc, motors); break;
    case JPH::EConstraintSubType::SixDOF:
      drive_six_axes(static_cast<JPH::SixDOFConstraint&>(main), desc, true, motors);
      break;
    default: break;
  }
  if (joint.helper != nullptr) drive_six_axes(static_cast<JPH::SixDOFConstraint&>(*joint.helper), desc, false, true);
}

}  // namespace plumb::jolt
