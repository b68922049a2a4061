// A joint. Most are links of DART's skeletons: a body is the child of the other and moves along the joint's free axes.
// What would close a loop, and rods, are rows between bodies that both move by themselves.
#pragma once

#include <array>

#include "articulated/joint_axes.hpp"
#include "body.hpp"

namespace plumb::dart6 {

struct Joint {
  PlumbJoint handle = 0;
  PlumbJointDesc desc{};  ///< with the motors as they are now
  Body* a = nullptr;      ///< null: the world
  Body* b = nullptr;
  bool is_link = false;
  std::array<::dart::dynamics::Joint*, 6> axis_joint{};  ///< of a link: DART's joint of each free axis; null: none
  PlumbVec3 force{}, torque{};  ///< on b at frame b's origin, world axes, mean over the last step

  [[nodiscard]] PlumbPose frame_a() const { return a == nullptr ? desc.frame_a : compose(a->pose, desc.frame_a); }
  [[nodiscard]] PlumbPose frame_b() const { return compose(b->pose, desc.frame_b); }
  [[nodiscard]] bool may_break() const { return desc.break_force > 0 || desc.break_torque > 0; }
};

using articulated::asks_nothing, articulated::is_limited, articulated::is_plain_ball, articulated::open_axes;

/// Whether it can be one of a skeleton's: a rod cannot, nor what joins a body that does not turn.
[[nodiscard]] bool can_be_link(const Joint& joint);
/// Whether rows can hold it: nothing is asked of the axes that it leaves free.
[[nodiscard]] bool can_close_a_loop(const PlumbJointDesc& desc);
/// Throws Error (PLUMB_E_UNSUPPORTED) for what a rod has not.
void check_joint(const PlumbJointDesc& desc);

/// N/m and N s/m, or N m/rad and N m s/rad, of an axis's spring, whichever way they were told.
struct Stiffness {
  double stiffness, damping;
};
[[nodiscard]] Stiffness stiffness_of(const Joint& joint, std::size_t axis);

}  // namespace plumb::dart6
