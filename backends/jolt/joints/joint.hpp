// A joint: Jolt's constraint, and the descriptor that it was made from.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Constraints/SixDOFConstraint.h>

#include "jolt_math.hpp"

namespace plumb::jolt {

struct Joint {
  PlumbJoint handle = 0;
  PlumbJointDesc desc{};  ///< with the motors and rests as they are now
  bool enabled = true;    ///< else it lets its bodies go and touch
  JPH::Ref<JPH::TwoBodyConstraint> main;
  /// Beside it, or null: one that has the motors where springs have the main one's, or a distance's spring beside its
  /// limits.
  JPH::Ref<JPH::TwoBodyConstraint> helper;
  PlumbPose at_a = identity_pose(), at_b = identity_pose();  ///< its frames in world axes as the last step began

  [[nodiscard]] bool keeps_apart() const { return enabled && desc.collide_connected == 0 && desc.body_a != 0; }
  [[nodiscard]] bool may_break() const { return enabled && (desc.break_force > 0 || desc.break_torque > 0); }
};

/// What a joint holds on to: bodies, and its frames in them, from their centres of mass.
struct Ends {
  JPH::Body& a;  ///< Body::sFixedToWorld for the world
  JPH::Body& b;
  PlumbPose frame_a, frame_b;
};
/// A frame as Jolt takes it.
struct Frame {
  explicit Frame(const PlumbPose& pose)
      : origin(vector(pose.position, "frame")),
        x(quaternion(pose.orientation).RotateAxisX()),
        y(quaternion(pose.orientation).RotateAxisY()) {}

  JPH::Vec3 origin, x, y;
};

/// A number of a joint.
[[nodiscard]] inline float number(double of_joint) { return scalar(of_joint, "a number of a joint"); }

/// Throws Error (PLUMB_E_UNSUPPORTED) for what Jolt's constraint of that type has not.
void check_joint(const PlumbJointDesc& desc);
/// Makes main, and helper where it takes one.
void make_constraints(Joint& joint, const Ends& ends);
/// Makes helper where the descriptor takes one by now and there is none; whether it did.
bool make_helper(Joint& joint, const Ends& ends);
/// Hands motors and springs of the descriptor to the constraints.
void drive(const Joint& joint);
/// Force and torque on b at its frame's origin, world axes, N s and N m s: the velocity solver's, in the last part of
/// the step.
struct Impulse {
  PlumbVec3 force{}, torque{};
};
[[nodiscard]] Impulse reaction(const Joint& joint);

/// axis_joints.cpp: ball, hinge, slider, distance, fixed.
[[nodiscard]] JPH::Ref<JPH::TwoBodyConstraint> make_axis_joint(const PlumbJointDesc& desc, const Ends& ends);
[[nodiscard]] JPH::Ref<JPH::TwoBodyConstraint> make_distance_spring(const PlumbJointDesc& desc, const Ends& ends);
/// Where a hinge or slider has its zero, seen from ours: Jolt's limits have 0 within.
[[nodiscard]] double zero_of(const PlumbLimit& limit);
/// Limits of a hinge or slider, as Jolt has them.
struct AxisLimits {
  float lower, upper;
};
[[nodiscard]] AxisLimits hinge_limits(const PlumbJointDesc& desc);
[[nodiscard]] AxisLimits slider_limits(const PlumbJointDesc& desc);
[[nodiscard]] JPH::SpringSettings spring_settings(const PlumbSpring& spring);

/// six_axes.cpp: universal, generic, swing-twist, and balls with more than their origins.
[[nodiscard]] bool takes_six_axes(const PlumbJointDesc& desc);
/// Whether Jolt's first body is our second: its order of turns is the other way round.
[[nodiscard]] bool is_swapped(const PlumbJointDesc& desc);
[[nodiscard]] JPH::Ref<JPH::TwoBodyConstraint> make_six_axes(const PlumbJointDesc& desc, const Ends& ends);
/// One that locks nothing, for motors.
[[nodiscard]] JPH::Ref<JPH::TwoBodyConstraint> make_free_axes(const PlumbJointDesc& desc, const Ends& ends);
void drive_six_axes(JPH::SixDOFConstraint& constraint, const PlumbJointDesc& desc, bool springs, bool motors);

/// meshing.cpp: gear, rack and pinion.
[[nodiscard]] JPH::Ref<JPH::TwoBodyConstraint> make_meshing(const PlumbJointDesc& desc, const Ends& ends);
/// On b at its centre of mass.
[[nodiscard]] Impulse meshing_impulse(const JPH::TwoBodyConstraint& constraint);

}  // namespace plumb::jolt
