// Joints of bodies that have moved already: position-based dynamics over the rows of joint_solve.hpp and
// joint_axis_solve.hpp.
#pragma once

#include "joints/joint_axis_solve.hpp"

namespace plumb::impulse {

/// Moves a body by what its change of velocity makes in h seconds.
PLUMB_HD inline void displace(const JointView& view, std::uint32_t body, const Velocity& before, const Velocity& after,
                              Real h) {
  if (!(before.inverse_mass > 0)) return;
  Displacement& displacement = view.solver.displacement[body];
  displacement.linear += h * (after.linear - before.linear);
  displacement.rotation = normalized(turn_by(h * (after.angular - before.angular)) * displacement.rotation);
}

/// What was done to a joint's bodies moves them, too.
PLUMB_HD inline void displace_bodies(const JointView& view, std::uint32_t j, const Velocity& a, const Velocity& b,
                                     const Velocity& new_a, const Velocity& new_b, Real h) {
  store_bodies(view, j, a, b, new_a, new_b);
  if (!leads_lanes()) return;
  displace(view, view.joints[j].body_a, a, new_a, h);
  displace(view, view.joints[j].body_b, b, new_b, h);
}

/// Puts the two bodies of a plain joint where it holds them (to first order), and gives them the velocity that this
/// took. To those that turn too far for that it gives the velocity that would take them there.
PLUMB_HD inline void correct_joint(const JointView& view, std::uint32_t j, const StepParameters& step) {
  refresh_joint(view, j);
  const Joint& joint = view.joints[j];
  const JointWork& work = view.work[j];
  const int n = row_count(joint);
  const Velocity a = view.velocity(joint.body_a), b = view.velocity(joint.body_b);
  Lanes speed(0);
  if (turns_far(a, b, step.h)) speed = speeds_now(view, j, a, b);
  const Lanes impulse = solved_lanes(work.factor, n, -(speed + Lanes(step.inverse_h) * load_row(work.error)));
  each_row(0, n, [&](int i) { view.impulses[joint.slot].along[i] = of_row(impulse, i); });
  RowNumbers all;
  spread(impulse, all);
  Velocity new_a = a, new_b = b;
  push_joint(work, n, all, new_a, new_b);
  displace_bodies(view, j, a, b, new_a, new_b, step.h);
}

/// The same of a joint that is not plain.
PLUMB_HD inline void correct_axis_joint(const AxisView& view, std::uint32_t j, const StepParameters& step) {
  const Joint& joint = view.joints[j];
  refresh_axis_joint(view, j);
  each_row(0, row_count(joint), [&](int i) { view.total(j)[i] = 0; });
  const Velocity a = view.velocity(joint.body_a), b = view.velocity(joint.body_b);
  Velocity new_a = a, new_b = b;
  solve_axis_rows(view, j, {PassKind::kMoved, step.h, step.inverse_h, rigid(step.inverse_h)}, new_a, new_b);
  displace_bodies(view, j, a, b, new_a, new_b, step.h);
}

/// first: of a step.
PLUMB_HD inline void correct(const JointView& view, std::uint32_t j, const StepParameters& step, bool /*first*/) {
  correct_joint(view, j, step);
}
PLUMB_HD inline void correct(const AxisView& view, std::uint32_t j, const StepParameters& step, bool first) {
  begin_reaction(view, j, first && !step.is_later_part);
  if (is_plain(view.joints[j]))
    correct_joint(view, j, step);
  else
    correct_axis_joint(view, j, step);
  add_reaction(view, j);
}

}  // namespace plumb::impulse
