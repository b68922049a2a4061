// The solver "tgs_soft": sub-steps with soft contacts and relaxation.
#pragma once

#include "solver/mechanisms.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

/// Sub-steps with soft constraints and relaxation ("soft step": Catto, "Solver2D", 2024; sub-stepping after Macklin et
/// al., "Small Steps in Physics Simulation", SCA 2019). In each sub-step velocities are solved with a soft bias against
/// overlap, positions moved, and velocities solved again without the bias, so that what it pushed does not stay.
struct StepSoftly : SolverStep {
  PLUMB_DEVICE void operator()(Team& team) const {
    if (must_repeat()) return;
    const StepParameters step = *parameters;
    for (std::uint32_t k = 0; k < step.substeps; ++k) {
      const bool first = k == 0;
      team.each(body_count, [&](std::uint32_t i) { integrate_velocity(bodies, solver, step, first, i); });
      if (first) warm_start(team);
      warm_start_mechanisms(team, joints, first, step);
      solve_mechanisms(team, joints, step, true);
      solve_contacts(team, step, true);
      move_bodies(team, step);
      solve_mechanisms(team, joints, step, false);
      solve_contacts(team, step, false);
    }
    if (features.collision && features.restitution) {
      bounce(team, step.restitution_speed);
      solve_mechanisms(team, joints, step, false);  // what bounced takes along what it is joined to
    }
    finish(team);
  }

 private:
  PLUMB_DEVICE void warm_start(Team& team) const {
    if (!features.collision) return;
    for_contacts(team, contacts, solver, BodyUse::kVelocity,
                 [](const auto& row, int points, auto& a, auto& b) { warm_start_contact(row, points, a, b); });
  }
  PLUMB_DEVICE void solve_contacts(Team& team, const StepParameters& step, bool take_back_overlap) const {
    if (!features.collision) return;
    const ContactPass pass = {step.contact,
                              step.ground,
                              step.inverse_h,
                              step.push_speed,
                              take_back_overlap,
                              features.friction,
                              take_back_overlap && features.restitution};
    const bool add_up = !take_back_overlap && features.contact_impulses;
    for_contacts(team, contacts, solver, take_back_overlap ? BodyUse::kVelocityWhereMoved : BodyUse::kVelocity,
                 [&](const auto& row, int points, auto& a, auto& b) {
                   using N = std::remove_cvref_t<decltype(a.inverse_mass)>;
                   ManifoldAim<N> aims;
                   aim_normals(row, points, a, b, pass, aims);
                   solve_normals(row, points, aims, a, b, pass);
                   if (pass.friction) {
                     // Friction below the centre tilts a body: the normals have the last word.
                     solve_friction(row, points, a, b);
                     solve_normals(row, points, aims, a, b, pass);
                   }
                   if (add_up) add_up_impulses(row, points);
                 });
  }
};

}  // namespace plumb::impulse
