// The solver "tgs_soft": sub-steps with soft contacts and relaxation.
#pragma once

#include "solver/axis_mechanisms.hpp"
#include "solver/mechanisms.hpp"
#include "solver/soft_contacts.hpp"

namespace plumb::impulse {

/// Sub-steps with soft constraints and relaxation ("soft step": Catto, "Solver2D", 2024; sub-stepping after Macklin et
/// al., "Small Steps in Physics Simulation", SCA 2019). In each sub-step velocities are solved with a soft bias against
/// overlap, positions moved, and velocities solved again without the bias, so that what it pushed does not stay.
template <JointCode kJoints, bool kBelts>
struct StepSoftly : SoftContacts<kBelts> {
  using SolverStep::bodies, SolverStep::solver, SolverStep::body_count, SolverStep::features, SolverStep::joints;

  PLUMB_DEVICE void operator()(Team& team) const {
    if (this->must_repeat()) return;
    const StepParameters step = *this->parameters;
    [[maybe_unused]] std::uint32_t turn = 0;
    for (std::uint32_t k = 0; k < step.substeps; ++k) {
      const bool first = k == 0;
      team.each(body_count, [&](std::uint32_t i) { integrate_velocity(bodies, solver, step, first, i); });
      if (first && features.collision) this->warm_start_contacts(team);
      if constexpr (kJoints == JointCode::kPlain) {
        warm_start_mechanisms(team, joints, first, step);
        solve_mechanisms(team, joints, step, true);
      }
      if constexpr (kJoints == JointCode::kAll) {
        warm_start_axes(team, joints, first, step);
        solve_axes(team, joints, step, RowPass::kPlaces, turn);
      }
      const bool relaxes = !step.relaxes_once || k + 1 == step.substeps;
      if (features.collision) this->push_contacts(team, step, !relaxes);
      this->move_bodies(team, step);
      hold_speeds(team, step, turn);
      if (relaxes && features.collision) this->relax_contacts(team);
    }
    if (features.collision && features.restitution) {
      this->bounce_contacts(team, step.restitution_speed);
      hold_speeds(team, step, turn);  // what bounced takes along what it is joined to
    }
    this->finish(team);
  }

 private:
  PLUMB_DEVICE void hold_speeds(Team& team, const StepParameters& step, [[maybe_unused]] std::uint32_t& turn) const {
    if constexpr (kJoints == JointCode::kPlain) solve_mechanisms(team, joints, step, false);
    if constexpr (kJoints == JointCode::kAll) solve_axes(team, joints, step, RowPass::kSpeeds, turn);
  }
};

}  // namespace plumb::impulse
