// The solver "tgs_soft": sub-steps with soft contacts and relaxation.
#pragma once

#include "joints/mechanisms.hpp"
#include "solver/soft_contacts.hpp"

namespace plumb::impulse {

/// Sub-steps with soft constraints and relaxation ("soft step": Catto, "Solver2D", 2024; sub-stepping after Macklin et
/// al., "Small Steps in Physics Simulation", SCA 2019). In each sub-step velocities are solved with a soft bias against
/// overlap, positions moved, and velocities solved again without the bias, so that what it pushed does not stay.
template <JointCode kJoints, bool kSurfaceEffects, bool kImpacts>
struct StepSoftly : SoftContacts<kSurfaceEffects, !Executor::kWarps || kJoints != JointCode::kContacts, kImpacts> {
  using SolverStep::solver, SolverStep::features, SolverStep::joints;

  PLUMB_DEVICE void operator()(Team& team) const {
    if (this->must_repeat()) return;
    StepParameters step = *this->parameters;
    std::uint32_t round = 0;  // of impacts
    for (std::uint32_t level = 0; level == 0 || level < this->counters->levels.count; ++level) {
      if (this->is_empty(level)) continue;
      static_cast<SubstepParameters&>(step) = this->levels->of[level];
      step_level(team, step, round);
    }
    this->finish(team);
  }

 private:
  /// The islands that have sub-steps of one length.
  PLUMB_DEVICE void step_level(Team& team, const StepParameters& step, std::uint32_t& round) const {
    if (step.level != 0) {
      this->forget_strikes(team);
      this->begin_ways(team);
    }
    for (std::uint32_t k = 0; k < step.substeps; ++k) {
      const bool first = k == 0;
      this->accelerate_bodies(team, step, first);
      if (first && features.collision) this->warm_start_contacts(team, step);
      if constexpr (kJoints != JointCode::kContacts) {
        const auto view = view_of<kJoints>(joints);
        warm_start_joints(team, joints, view, first, step);
        solve_joints(team, joints, view, step, PassKind::kPlaces, features.collision, first);
      }
      const bool relaxes = !step.relaxes_once || k + 1 == step.substeps;
      if (features.collision) {
        begin_loads(team, step);
        this->bounce_contacts(team, step, k, round);
        this->push_contacts(team, step, k, !relaxes);
        end_loads(team, step);
        if constexpr (kJoints == JointCode::kAll) hold_limits(team, joints, view_of<kJoints>(joints), step, first);
      }
      this->move_bodies(team, step);
      if constexpr (kJoints == JointCode::kAll) follow_ways(team, joints, step);
      if (features.collision) hand_over_loads(team, step);
      hold_speeds(team, step, first);
      if (!relaxes || !features.collision) continue;
      begin_loads(team, step);
      for (std::uint32_t n = 1; n <= step.relaxations; ++n) this->relax_contacts(team, step, n == step.relaxations);
      if (k + 1 == step.substeps) continue;
      end_loads(team, step);
      hand_over_loads(team, step);
    }
  }
  PLUMB_DEVICE void hold_speeds(Team& team, const StepParameters& step, bool first) const {
    if constexpr (kJoints != JointCode::kContacts)
      solve_joints(team, joints, view_of<kJoints>(joints), step, PassKind::kSpeeds, features.collision, first);
  }
  /// Contacts are about to push mechanisms as a whole.
  PLUMB_DEVICE void begin_loads(Team& team, const StepParameters& step) const {
    each_place(team, step, [&](std::uint32_t place) { begin_load(solver, place); });
  }
  PLUMB_DEVICE void end_loads(Team& team, const StepParameters& step) const {
    each_place(team, step, [&](std::uint32_t place) { end_load(solver, place); });
  }
  /// The joints have yet to pass on what contacts did.
  PLUMB_DEVICE void hand_over_loads(Team& team, const StepParameters& step) const {
    each_place(team, step, [&](std::uint32_t place) { hand_over_load(solver, place); });
  }
  /// f(place) for the bodies of mechanisms.
  template <class F>
  PLUMB_DEVICE void each_place(Team& team, const StepParameters& step, const F& f) const {
    if constexpr (kJoints != JointCode::kContacts)
      team.each(solver.mechanisms.count, [&](std::uint32_t place) {
        if (solver.levels(solver.mechanisms.bodies[place].body) == step.level) f(place);
      });
  }
};

}  // namespace plumb::impulse
