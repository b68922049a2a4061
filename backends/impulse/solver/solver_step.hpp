// What every solver's step works on, and the parts that are the same in all of them.
#pragma once

#include "bodies/motion_lanes.hpp"
#include "contacts/contact_loops.hpp"
#include "exec/atomic.hpp"
#include "joints/joint_loops.hpp"
#include "solver/solver.hpp"

namespace plumb::impulse {

struct SolverStep {
  MovableBodies bodies;
  SolverBodies solver;
  ContactSet contacts;
  std::uint32_t body_count;
  SolverFeatures features;
  const StepParameters* parameters;
  StepCounters* counters;
  std::uint32_t pair_capacity;
  JointSet joints;
  const SubstepLevels* levels;
  const std::uint32_t* body_groups_of_levels;  ///< as of LoadWork
  std::uint32_t most_groups;

  /// Nothing may be done.
  PLUMB_DEVICE bool must_repeat() const { return is_undone(*counters, pair_capacity); }

  /// Whether no body has sub-steps of that level.
  [[nodiscard]] PLUMB_DEVICE bool is_empty(std::uint32_t level) const {
    return counters->levels.count > 1 && counters->levels.body_groups[level] == 0;
  }
  /// first: of the step's sub-steps, or each where constraint impulses are not carried over.
  PLUMB_DEVICE void accelerate_bodies(Team& team, const StepParameters& step, bool first) const {
    each_body_group(team, step,
                    [&](const BodyGroup& group) { integrate_velocities(bodies, solver, step, first, group); });
  }
  PLUMB_DEVICE void move_bodies(Team& team, const StepParameters& step) const {
    each_body_group(team, step, [&](const BodyGroup& group) {
      integrate_positions(bodies, solver, step, features.gyroscopic, group);
    });
  }
  PLUMB_DEVICE void finish(Team& team) const {
    team.each(body_count, [&](std::uint32_t i) {
      if (!finish_body(bodies, solver, i)) atomic_add(&counters->nonfinite, 1U);
    });
  }

 private:
  /// f(group) for the bodies that have sub-steps of the step's level.
  template <class F>
  PLUMB_DEVICE void each_body_group(Team& team, const StepParameters& step, const F& f) const {
    if (counters->levels.count <= 1) {
      team.each(body_groups(body_count), [&](std::uint32_t group) { f(BodyGroup(group, body_count)); });
    } else {
      const std::uint32_t* const groups = body_groups_of_levels + step.level * most_groups;
      team.each(counters->levels.body_groups[step.level],
                [&](std::uint32_t k) { f(BodyGroup(groups[k], body_count, solver.levels, step.level)); });
    }
  }
};

}  // namespace plumb::impulse
