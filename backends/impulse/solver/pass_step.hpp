// What the solvers that take the step whole have in common: passes over all constraints until these change no more.
#pragma once

#include "constraints/contact_bias.hpp"
#include "solver/pass_change.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

/// All forces, then passes over the constraints, each of which takes the impulse that makes its own speed right, then
/// positions from the final velocities. Overlap beyond the slop is taken back at a share a step (Baumgarte). No
/// sub-steps. Solver says in what order contacts are gone through: for_each_contact(team, work), and bounces them:
/// bounce_contacts(team, step).
template <class Solver, JointCode kJoints>
struct StepInPasses : SolverStep {
  PassChange* changes;  ///< by pass

  PLUMB_DEVICE void operator()(Team& team) const {
    if (must_repeat()) return;
    const StepInPasses self = *this;
    const Solver& own = static_cast<const Solver&>(*this);
    const StepParameters step = *parameters;
    team.each(max(body_count, step.passes), [=](std::uint32_t i) {
      if (i < self.body_count) integrate_velocity(self.bodies, self.solver, step, true, i);
      if (i < step.passes) self.changes[i] = {0, 0};
    });
    start_joints(team, step);
    if (features.collision) start(team, step);
    std::uint32_t passes = 0;
    while (passes < step.passes) {
      PassChange* const noted = step.stop_below > 0 ? &changes[passes] : nullptr;
      solve_joints_noted<kJoints>(team, joints, step, noted);
      if (features.collision) solve_contacts(team, noted);
      ++passes;
      team.meet();
      if (noted != nullptr && noted->is_below(step.stop_below)) break;
    }
    team.single([=] { self.counters->passes = passes; });
    if constexpr (kJoints == JointCode::kAll) add_reactions(team, joints);
    if (features.collision && features.contact_impulses) add_up(team);
    move_bodies(team, step);
    if (features.collision && features.restitution) own.bounce_contacts(team, step);
    finish(team);
  }

 private:
  /// What takes back an error is kept with the impulses: of passes that do not come to their end that makes an
  /// integrator of the error, which swings up unless it leaks faster than the error is taken back.
  PLUMB_DEVICE void start_joints(Team& team, const StepParameters& step) const {
    StepParameters leaking = step;
    leaking.warm_start = step.warm_start * max(Real(0), Real(1) - Real(1.5) * (step.bias_rate * step.dt));
    if constexpr (kJoints == JointCode::kAll)
      warm_start_axes(team, joints, true, leaking);
    else
      warm_start_joints(team, joints, leaking);
  }
  PLUMB_DEVICE void start(Team& team, const StepParameters& step) const {
    static_cast<const Solver&>(*this).for_each_contact(team, [=](const auto& row, auto& contact, auto& a, auto& b) {
      put_bias(contact, step);
      store_impulses(row, contact);
      warm_start_contact(contact, a, b);
    });
  }
  PLUMB_DEVICE void solve_contacts(Team& team, PassChange* noted) const {
    const ContactPass pass = {features.friction, features.restitution, noted};
    static_cast<const Solver&>(*this).for_each_contact(
        team, [pass](const auto& row, auto& contact, auto& a, auto& b) { pass.solve(row, contact, a, b); });
  }
};

}  // namespace plumb::impulse
