// What the solvers that take the step whole have in common: passes over all constraints until these change no more.
#pragma once

#include "joints/mechanisms.hpp"
#include "solver/impacts.hpp"
#include "solver/pass_contacts.hpp"

namespace plumb::impulse {

/// f(j) on a joint, and how much it changed the impulses.
template <class F>
PLUMB_HD void note_joint(const JointView& view, std::uint32_t j, PassChange* noted, const F& f) {
  const JointImpulse before = view.impulses[view.joints[j].slot];
  lanes_meet();
  f(j);
  lanes_meet();
  if (noted == nullptr || !leads_lanes()) return;
  const JointImpulse& now = view.impulses[view.joints[j].slot];
  Real changed = 0, reached = 0;
  for (int i = 0; i < row_count(view.joints[j]); ++i) {
    changed = max(changed, zero_unless_finite(abs(now.along[i] - before.along[i])));
    reached = max(reached, zero_unless_finite(abs(now.along[i])));
  }
  noted->note(changed, reached);
}

/// All joints in one pass: impulses that make J V = -bias_rate C, with J and C from the start of the step (Baumgarte).
template <class View>
PLUMB_DEVICE void solve_joints_noted(Team& team, const JointSet& joints, const View& view, const StepParameters& step,
                                     PassChange* noted) {
  const JointPass pass = {PassKind::kWhole, step.h, step.inverse_h, rigid(step.bias_rate)};
  for_joints(team, joints,
             [=](std::uint32_t j) { note_joint(view, j, noted, [&](std::uint32_t i) { solve(view, i, pass); }); });
}

/// All forces, then passes over the constraints, each of which takes the impulse that makes its own speed right, then
/// positions from the final velocities. Overlap beyond the slop is taken back at a share a step (Baumgarte). No
/// sub-steps.
template <class Order, JointCode kJoints>
struct StepInPasses : PassContacts<Order> {
  using SolverStep::body_count, SolverStep::features, SolverStep::joints;
  using PassContacts<Order>::changes;

  PLUMB_DEVICE void operator()(Team& team) const {
    if (this->must_repeat()) return;
    const StepInPasses self = *this;
    const StepParameters step = *this->parameters;
    team.each(max(body_count, step.passes), [=](std::uint32_t i) {
      if (i < self.body_count) integrate_velocity(self.bodies, self.solver, step, true, i);
      if (i < step.passes) self.changes[i] = {0, 0};
    });
    if constexpr (Order::kInSequence) {
      std::uint32_t round = 0;
      if (features.collision && features.restitution) solve_impacts<Order::kEffects, false>(team, *this, step, round);
    }
    const auto view = view_of<kJoints>(joints);
    start_joints(team, view, leaking(step));
    if (features.collision) this->start_contacts(team, step);
    std::uint32_t passes = 0;
    while (passes < step.passes) {
      PassChange* const noted = step.stop_below > 0 ? &changes[passes] : nullptr;
      solve_joints_noted(team, joints, view, step, noted);
      if (features.collision) this->solve_contacts(team, noted);
      ++passes;
      team.barrier();
      if (noted != nullptr && noted->is_below(step.stop_below)) break;
    }
    team.single([=] { self.counters->passes = passes; });
    if constexpr (kHasReactions<decltype(view_of<kJoints>(joints))>)
      each_by_rows(team, joints.count, [=](std::uint32_t j) {
        add_reaction(view, j);
        add_way(view, j, step.h);
      });
    if (features.collision && features.contact_impulses) this->add_up(team);
    this->move_bodies(team, step);
    if constexpr (!Order::kInSequence) {
      if (features.collision && features.restitution) this->bounce_contacts(team, step);
    }
    this->finish(team);
  }

 private:
  template <class View>
  PLUMB_DEVICE void start_joints(Team& team, const View& view, const StepParameters& step) const {
    each_by_rows(team, joints.count, [=](std::uint32_t j) {
      begin_joint(view, j, true, step);
      refresh(view, j);
    });
    for_joints(team, joints, [=](std::uint32_t j) { warm_start_joint(view, j); });
  }
  /// What takes back an error is kept with the impulses: of passes that do not come to their end that makes an
  /// integrator of the error, which swings up unless it leaks faster than the error is taken back.
  PLUMB_HD static StepParameters leaking(StepParameters step) {
    step.warm_start = step.warm_start * max(Real(0), Real(1) - Real(1.5) * (step.bias_rate * step.dt));
    return step;
  }
};

}  // namespace plumb::impulse
