// A joint: Box3D's, and the descriptor that it was made from.
#pragma once

#include "box3d_math.hpp"

namespace plumb::box3d {

struct Joint {
  PlumbJoint handle = 0;
  b3JointId id{};
  PlumbJointDesc desc{};  ///< with the motors as they are now

  [[nodiscard]] bool may_break() const { return desc.break_force > 0 || desc.break_torque > 0; }
};

/// Whether the adapter gives a type of joint limits, motors, springs.
[[nodiscard]] bool joint_has(PlumbJointType type, PlumbJointFeature feature);
/// The one axis on which it gives them.
[[nodiscard]] constexpr std::size_t driven_axis(PlumbJointType type) { return type == PLUMB_JOINT_HINGE ? 3 : 0; }

/// Throws Error (PLUMB_E_UNSUPPORTED) for limits, motors and springs that Box3D's joint has not.
void check_joint(const PlumbJointDesc& desc);

/// What all joints have in common: bodies, frames, softness.
[[nodiscard]] b3JointDef base_of(const PlumbJointDesc& desc, b3BodyId a, b3BodyId b);
[[nodiscard]] b3JointId make_joint(b3WorldId world, const PlumbJointDesc& desc, const b3JointDef& base);

/// Hands the motor of the descriptor to the joint, or where its spring rests.
void apply_motor(const Joint& joint);
void apply_rest(const Joint& joint);

}  // namespace plumb::box3d
