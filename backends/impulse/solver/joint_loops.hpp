// Loops over all joints: what every solver does with them.
#pragma once

#include "constraints/joint_solve.hpp"
#include "exec/executor.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kJointColours = 32;

/// The joints of a step, sorted by colour: those of one colour share no body that they push. The last colour may hold
/// any: its joints are solved one after the other.
struct JointSet {
  JointView view;
  const std::uint32_t* first;  ///< of each colour, and of the end behind the last
  std::uint32_t count, colours;
  bool last_is_overflow;
};

/// f(j) for every joint, colour after colour.
template <class F>
PLUMB_DEVICE void for_joints(Team& team, const JointSet& joints, const F& f) {
  for (std::uint32_t colour = 0; colour < joints.colours; ++colour) {
    const std::uint32_t first = joints.first[colour], end = joints.first[colour + 1];
    if (joints.last_is_overflow && colour + 1 == joints.colours)
      team.single([=] {
        for (std::uint32_t j = first; j < end; ++j) f(j);
      });
    else
      team.each(end - first, [=](std::uint32_t i) { f(first + i); });
  }
}

PLUMB_DEVICE inline void refresh_joints(Team& team, const JointSet& joints) {
  const JointView view = joints.view;
  team.each(joints.count, [=](std::uint32_t j) { refresh_joint(view, j); });
}

PLUMB_DEVICE inline void warm_start_joints(Team& team, const JointSet& joints, bool first, const StepParameters& step) {
  if (joints.count == 0) return;
  if (first) refresh_joints(team, joints);
  const JointView view = joints.view;
  for_joints(team, joints, [=](std::uint32_t j) { warm_start_joint(view, j, first, step); });
}

PLUMB_DEVICE inline void solve_joints(Team& team, const JointSet& joints, const StepParameters& step,
                                      bool take_back_error) {
  if (joints.count == 0) return;
  if (!take_back_error) refresh_joints(team, joints);
  const JointView view = joints.view;
  const JointPass pass = {step.joint, step.h, step.inverse_h, take_back_error};
  for_joints(team, joints, [=](std::uint32_t j) { solve_joint(view, j, pass); });
}

}  // namespace plumb::impulse
