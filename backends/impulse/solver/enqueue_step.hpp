// The kernel of a step: which solver, and how much of joints it can do.
#pragma once

#include "solver/jacobi_step.hpp"
#include "solver/position_step.hpp"
#include "solver/sequential_step.hpp"
#include "solver/soft_step.hpp"

namespace plumb::impulse {

struct StepWork {
  SolverStep step;
  PassChange* changes;
  BodyParts parts;
  SolverKind kind;
  Count load;
  std::uint32_t least;
};

/// Only the default solver has code of its own for a step without joints. kSurfaceEffects: surfaces may run on bodies
/// that stand, and resist rolling.
template <JointCode kJoints, bool kSurfaceEffects = !Executor::kWarps>
void enqueue_step(Executor& executor, const StepWork& work) {
  constexpr JointCode kOthers = kJoints == JointCode::kContacts ? JointCode::kPlain : kJoints;
  const auto run = [&](const auto& solver) { executor.team(work.load, work.least, solver); };
  switch (work.kind) {
    case SolverKind::kSequential: return run(StepSequentially<kOthers, kSurfaceEffects>{{{work.step}, work.changes}});
    case SolverKind::kJacobi:
      return run(StepInParts<kOthers, kSurfaceEffects>{{{work.step, work.parts}, work.changes}});
    case SolverKind::kPosition: return run(StepPositions<kOthers, kSurfaceEffects>{{work.step}});
    case SolverKind::kTgsSoft: break;
  }
  // The code of impacts takes registers of a GPU from the passes beside it.
  if constexpr (Executor::kWarps && kJoints == JointCode::kContacts) {
    if (!work.step.features.restitution) return run(StepSoftly<kJoints, kSurfaceEffects, false>{{work.step}});
  }
  run(StepSoftly<kJoints, kSurfaceEffects, true>{{work.step}});
}

/// Of JointCode::kAll, compiled in files of their own. A device has kernels of their own for surface effects, too.
void enqueue_step_with_axes(Executor& executor, const StepWork& work);
void enqueue_step_with_surface_effects(Executor& executor, const StepWork& work);

}  // namespace plumb::impulse
