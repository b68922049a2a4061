// A joint: PhysX's, and the descriptor that they were made from.
#pragma once

#include <memory>
#include <vector>

#include "joints/own_row.hpp"
#include "physx_math.hpp"

namespace plumb::px {

/// What a joint holds on to: actors, and its frames in them.
struct Ends {
  PxRigidActor* a;  ///< null: the world
  PxRigidActor* b;
  PxTransform frame_a, frame_b;
};

struct Joint {
  struct ReleaseJoint {
    void operator()(PxJoint* joint) const { joint->release(); }
  };
  using Native = std::unique_ptr<PxJoint, ReleaseJoint>;

  PlumbJoint handle = 0;
  PlumbJointDesc desc{};                      ///< with the motors and rests as they are now
  bool enabled = true;                        ///< else it lets its bodies go and touch
  Native main;                                ///< null: an own row is all, or none of the bodies moves
  std::vector<std::unique_ptr<OwnRow>> rows;  ///< of the adapter's own

  [[nodiscard]] bool keeps_apart() const { return enabled && desc.collide_connected == 0 && desc.body_a != 0; }
  [[nodiscard]] bool may_break() const { return enabled && (desc.break_force > 0 || desc.break_torque > 0); }
};

/// A number of a joint.
[[nodiscard]] inline float number(double of_joint) { return scalar(of_joint, "a number of a joint"); }

/// Throws Error for numbers that PhysX cannot hold.
void check_joint(const PlumbJointDesc& desc);
/// Makes what holds, from the descriptor: of a joint whose bodies all stand nothing.
void make_native(Joint& joint, const Ends& ends);
void drop_native(Joint& joint);
/// Hands motors and rests of the descriptor on. False: something else is needed than was made, and it must be anew.
[[nodiscard]] bool drive(Joint& joint);

/// Force and torque on b at its frame's origin, world axes, N and N m.
struct Reaction {
  PlumbVec3 force{}, torque{};
};
[[nodiscard]] Reaction reaction(const Joint& joint);

/// Whether PhysX's first body is our second.
[[nodiscard]] bool is_swapped(const PlumbJointDesc& desc);

/// six_axes.cpp
[[nodiscard]] bool takes_six_axes(const PlumbJointDesc& desc);
[[nodiscard]] PxD6Joint* make_six_axes(const PlumbJointDesc& desc, const Ends& ends);
/// Springs along its axes.
void drive_six_axes(PxD6Joint& native, const PlumbJointDesc& desc);

}  // namespace plumb::px
