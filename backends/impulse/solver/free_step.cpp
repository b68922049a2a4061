// Steps of bodies that meet nothing and are joined to nothing.
#include "bodies/motion_lanes.hpp"
#include "exec/atomic.hpp"
#include "solver/solver.hpp"

namespace plumb::impulse {

namespace {

/// With no constraint between them bodies need not go through the sub-steps together, and go through nothing else. What
/// the solvers would do to them is the same, to the last bit.
struct StepFreely {
  /// Bodies that one thread takes through the step: on a CPU as many as stay in the nearest cache, for a sub-step of
  /// one overlaps with those of the others.
  static constexpr std::uint32_t kTogether = Executor::kWarps ? 1 : 4 * kLaneGroup;

  MovableBodies bodies;
  SolverBodies solver;
  std::uint32_t body_count;
  const StepParameters* parameters;
  StepCounters* counters;

  [[nodiscard]] static constexpr std::uint32_t groups(std::uint32_t count) {
    return (count + kTogether - 1) / kTogether;
  }

  PLUMB_HD void operator()(std::uint32_t group) const {
    const StepParameters step = *parameters;
    const bool whole = step.solver == SolverKind::kSequential || step.solver == SolverKind::kJacobi;
    const bool carries = step.solver == SolverKind::kTgsSoft;
    const std::uint32_t substeps = whole ? 1 : step.substeps;
    const std::uint32_t first = group * kTogether, end = min(body_count, first + kTogether);
    const std::uint32_t first_group = first / kLanes, groups = body_groups(end);
    for (std::uint32_t i = first; i < end; ++i) begin_body(bodies, solver, step, step.h, i);
    for (std::uint32_t k = 0; k < substeps; ++k) {
      for (std::uint32_t g = first_group; g < groups; ++g)
        integrate_velocities(bodies, solver, step, !carries || k == 0, {g, body_count});
      for (std::uint32_t g = first_group; g < groups; ++g) integrate_positions(bodies, solver, step, {g, body_count});
    }
    for (std::uint32_t i = first; i < end; ++i)
      if (!finish_body(bodies, solver, step.dt, i)) atomic_add(&counters->nonfinite, 1U);
  }
};

}  // namespace

void Solver::move_freely(Executor& executor, const MovableBodies& all, std::uint32_t body_count,
                         const StepParameters* parameters, StepCounters* counters) {
  executor.run(StepFreely::groups(body_count),
               StepFreely{all, bodies(all, counters), body_count, parameters, counters});
}

}  // namespace plumb::impulse
