// The solver "si": sequential impulses over the whole step.
#pragma once

#include "constraints/contact_bias.hpp"
#include "solver/pass_change.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

/// Sequential impulses (Catto, "Iterative Dynamics with Temporal Coherence", 2005): all forces, then passes over the
/// constraints, each of which takes the impulse that makes its own speed right (projected Gauss-Seidel on accumulated
/// impulses), then positions from the final velocities. Overlap beyond the slop is taken back at a share a step
/// (Baumgarte). No sub-steps.
struct StepSequentially : SolverStep {
  PassChange* changes;  ///< by pass

  PLUMB_DEVICE void operator()(Team& team) const {
    if (must_repeat()) return;
    const StepSequentially self = *this;
    const StepParameters step = *parameters;
    team.each(max(body_count, step.passes), [=](std::uint32_t i) {
      if (i < self.body_count) integrate_velocity(self.bodies, self.solver, step, true, i);
      if (i < step.passes) self.changes[i] = {0, 0};
    });
    warm_start_joints(team, joints, true, step);
    if (features.collision) start(team, step);
    std::uint32_t passes = 0;
    while (passes < step.passes) {
      PassChange* const noted = step.stop_below > 0 ? &changes[passes] : nullptr;
      solve_joints_noted(team, joints, step, noted);
      if (features.collision) solve_contacts(team, noted);
      ++passes;
      team.meet();
      if (noted != nullptr && noted->is_below(step.stop_below)) break;
    }
    team.single([=] { self.counters->passes = passes; });
    if (features.collision && features.contact_impulses) add_up(team);
    move_bodies(team, step);
    if (features.collision && features.restitution) bounce(team, step.restitution_speed);
    finish(team);
  }

 private:
  PLUMB_DEVICE void start(Team& team, const StepParameters& step) const {
    for_contacts(team, contacts, solver, BodyUse::kVelocity,
                 [=](auto points, const auto& row, auto& contact, auto& a, auto& b) {
                   put_bias<points()>(contact, step);
                   store_impulses<points()>(row, contact);
                   warm_start_contact<points()>(contact, a, b);
                 });
  }
  PLUMB_DEVICE void solve_contacts(Team& team, PassChange* noted) const {
    const ContactPass pass = {features.friction, features.restitution, noted};
    for_contacts(team, contacts, solver, BodyUse::kVelocity,
                 [pass](auto points, const auto& row, auto& contact, auto& a, auto& b) {
                   pass.solve<points()>(row, contact, a, b);
                 });
  }
};

}  // namespace plumb::impulse
