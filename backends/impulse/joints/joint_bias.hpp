// Joints for solvers that take a step whole: rows as they stand at its start, and a share of the error taken back.
#pragma once

#include "joints/joint_solve.hpp"

namespace plumb::impulse {

/// Impulses that make J V = -bias_rate C, with J and C from the start of the step (Baumgarte).
PLUMB_HD inline void solve_joint_with_bias(const JointView& view, std::uint32_t j, Real bias_rate) {
  const Joint& joint = view.joints[j];
  const JointWork& work = view.work[j];
  JointImpulse& total = view.impulses[joint.slot];
  const int n = row_count(joint);
  const Velocity a = view.velocity(joint.body_a), b = view.velocity(joint.body_b);
  RowNumbers impulse;
  joint_residuals(view, j, JointPass{}, a, b, impulse);
  for (int i = 0; i < n; ++i) impulse[i] = impulse[i] + speed_of_error(bias_rate, work.error[i]);
  solve_factored(work.factor, n, impulse);
  for (int i = 0; i < n; ++i) {
    impulse[i] = -impulse[i];
    total.along[i] = total.along[i] + impulse[i];
  }
  Velocity new_a = a, new_b = b;
  push_joint(work, n, impulse, new_a, new_b);
  view.store(joint.body_a, a, new_a);
  view.store(joint.body_b, b, new_b);
}

}  // namespace plumb::impulse
