// Joints by Jolt's constraint of six axes, which takes turns apart into a twist about x and, after it, a swing.
#include <algorithm>

#include "joints/joint.hpp"
#include "plumb/backend/joint_coordinates.hpp"
#include "plumb/backend/usual_capability.hpp"

namespace plumb::jolt {
namespace {

using Settings = JPH::SixDOFConstraintSettings;

Settings::EAxis jolts(std::size_t axis) { return static_cast<Settings::EAxis>(axis); }

PlumbAxisMode mode_of(const PlumbJointDesc& desc, std::size_t axis) {
  if (desc.type == PLUMB_JOINT_GENERIC) return desc.axis_modes[axis];
  if ((backend::free_axes(desc.type) >> axis & 1) == 0) return PLUMB_AXIS_LOCKED;
  return desc.limits[axis].enabled != 0 ? PLUMB_AXIS_LIMITED : PLUMB_AXIS_FREE;
}

Settings between(const PlumbJointDesc& desc, const Ends& ends) {
  const bool swapped = is_swapped(desc);
  const Frame first(swapped ? ends.frame_b : ends.frame_a), second(swapped ? ends.frame_a : ends.frame_b);
  Settings settings;
  settings.mSpace = JPH::EConstraintSpace::LocalToBodyCOM;
  settings.mSwingType = desc.type == PLUMB_JOINT_SWING_TWIST ? JPH::ESwingType::Cone : JPH::ESwingType::Pyramid;
  settings.mPosition1 = JPH::RVec3(first.origin);
  settings.mPosition2 = JPH::RVec3(second.origin);
  settings.mAxisX1 = first.x;
  settings.mAxisY1 = first.y;
  settings.mAxisX2 = second.x;
  settings.mAxisY2 = second.y;
  return settings;
}

JPH::Ref<JPH::TwoBodyConstraint> create(const Settings& settings, const PlumbJointDesc& desc, const Ends& ends) {
  return is_swapped(desc) ? settings.Create(ends.b, ends.a) : settings.Create(ends.a, ends.b);
}

JPH::Quat turn_of(const PlumbJointDesc& desc) {
  double rest[3];
  for (std::size_t k = 0; k < 3; ++k) rest[k] = desc.springs[3 + k].enabled != 0 ? desc.springs[3 + k].rest : 0;
  if (desc.type == PLUMB_JOINT_SWING_TWIST)
    return quaternion(backend::turn_of_swing_twist({rest[0], rest[1], rest[2]}));
  PlumbQuat turn{0, 0, 0, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const double half = rest[k] / 2, s = std::sin(half);
    turn = backend::multiply(turn, {k == 0 ? s : 0, k == 1 ? s : 0, k == 2 ? s : 0, std::cos(half)});
  }
  return quaternion(is_swapped(desc) ? backend::conjugate(turn) : turn);
}

}  // namespace

bool takes_six_axes(const PlumbJointDesc& desc) {
  if (desc.type != PLUMB_JOINT_BALL)
    return desc.type == PLUMB_JOINT_UNIVERSAL || desc.type == PLUMB_JOINT_GENERIC ||
           desc.type == PLUMB_JOINT_SWING_TWIST;
  for (std::size_t axis = 3; axis < 6; ++axis)
    if (desc.limits[axis].enabled != 0 || desc.motors[axis].enabled != 0 || desc.springs[axis].enabled != 0)
      return true;
  return false;
}

/// Where it moves along axes they are those of our first body, and they come first.
bool is_swapped(const PlumbJointDesc& desc) {
  if (desc.type == PLUMB_JOINT_SWING_TWIST) return false;
  return mode_of(desc, 0) == PLUMB_AXIS_LOCKED && mode_of(desc, 1) == PLUMB_AXIS_LOCKED &&
         mode_of(desc, 2) == PLUMB_AXIS_LOCKED;
}

JPH::Ref<JPH::TwoBodyConstraint> make_six_axes(const PlumbJointDesc& desc, const Ends& ends) {
  Settings settings = between(desc, ends);
  const bool swapped = is_swapped(desc);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const PlumbAxisMode mode = mode_of(desc, axis);
    const float lower = number(desc.limits[axis].lower), upper = number(desc.limits[axis].upper);
    if (mode == PLUMB_AXIS_LOCKED) settings.MakeFixedAxis(jolts(axis));
    if (mode == PLUMB_AXIS_LIMITED)
      settings.SetLimitedAxis(jolts(axis), swapped ? -upper : lower, swapped ? -lower : upper);
  }
  return create(settings, desc, ends);
}

JPH::Ref<JPH::TwoBodyConstraint> make_free_axes(const PlumbJointDesc& desc, const Ends& ends) {
  return create(between(desc, ends), desc, ends);
}

void drive_six_axes(JPH::SixDOFConstraint& constraint, const PlumbJointDesc& desc, bool springs, bool motors) {
  const float way = is_swapped(desc) ? -1.0f : 1.0f;
  JPH::Vec3 speed = JPH::Vec3::sZero(), spin = JPH::Vec3::sZero(), rest = JPH::Vec3::sZero();
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const PlumbMotor& motor = desc.motors[axis];
    const PlumbSpring& spring = desc.springs[axis];
    const bool held = springs && spring.enabled != 0, driven = motors && motor.enabled != 0 && !held;
    JPH::MotorSettings& with = constraint.GetMotorSettings(jolts(axis));
    const float most = driven ? number(motor.max_force) : FLT_MAX;
    axis < 3 ? with.SetForceLimit(most) : with.SetTorqueLimit(most);
    if (held) with.mSpringSettings = spring_settings(spring);
    if (held && axis < 3) rest.SetComponent(static_cast<JPH::uint>(axis), number(spring.rest));
    if (driven)
      (axis < 3 ? speed : spin).SetComponent(static_cast<JPH::uint>(axis % 3), way * number(motor.target_velocity));
    constraint.SetMotorState(jolts(axis), held     ? JPH::EMotorState::PositionAndVelocity
                                          : driven ? JPH::EMotorState::Velocity
                                                   : JPH::EMotorState::Off);
  }
  constraint.SetTargetVelocityCS(speed);
  constraint.SetTargetAngularVelocityCS(spin);
  constraint.SetTargetPositionCS(rest);
  constraint.SetTargetOrientationCS(turn_of(desc));
}

}  // namespace plumb::jolt
