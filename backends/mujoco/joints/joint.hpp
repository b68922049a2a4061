// A joint. Most are links of MuJoCo's trees: a body is the child of the other and moves along the joint's free axes.
// What would close a loop, and rods, are constraints between bodies that both move by themselves.
#pragma once

#include <array>

#include "articulated/joint_axes.hpp"
#include "body.hpp"

namespace plumb::mujoco {

struct Joint {
  PlumbJoint handle = 0;
  PlumbJointDesc desc{};  ///< with the motors as they are now
  Body* a = nullptr;      ///< null: the world
  Body* b = nullptr;
  bool is_link = false;
  std::array<int, 6> axis_joint{};  ///< of a link: MuJoCo's joint of each free axis; -1: none
  int equality = -1;                ///< of the others: the first of MuJoCo's equalities
  int tendon = -1;                  ///< of a rod
  PlumbVec3 force{}, torque{};      ///< on b at frame b's origin, world axes, mean over the last step

  [[nodiscard]] PlumbPose frame_a() const { return a == nullptr ? desc.frame_a : compose(a->pose, desc.frame_a); }
  [[nodiscard]] PlumbPose frame_b() const { return compose(b->pose, desc.frame_b); }
  [[nodiscard]] bool may_break() const { return desc.break_force > 0 || desc.break_torque > 0; }
};

using articulated::asks_nothing, articulated::is_limited, articulated::is_plain_ball, articulated::kTurns,
    articulated::open_axes;

/// Whether it can be held where it closes a loop.
[[nodiscard]] bool can_close_a_loop(const PlumbJointDesc& desc);
/// Throws Error (PLUMB_E_UNSUPPORTED) for what a rod of MuJoCo has not.
void check_joint(const PlumbJointDesc& desc);

/// kg or kg m2, against which a force along the axis works, with nothing else holding the bodies.
[[nodiscard]] double effective_mass(const Joint& joint, std::size_t axis);

}  // namespace plumb::mujoco
