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
  /// Levels go through the step one after the other, and what the host moves goes with each of them.
  PLUMB_DEVICE void begin_ways(Team& team) const {
    if (counters->levels.count <= 1) return;
    team.each(counters->levels.body_groups[kEveryLevel], [&](std::uint32_t k) {
      const BodyGroup group = group_of(kEveryLevel, k);
      for (std::uint32_t i = group.begin; i < group.end; ++i) begin_way(bodies, solver, i);
    });
  }
  /// first: of the step's sub-steps, or each where constraint impulses are not carried over.
  PLUMB_DEVICE void accelerate_bodies(Team& team, const StepParameters& step, bool first) const {
    each_body_group(team, step,
                    [&](const BodyGroup& group) { integrate_velocities(bodies, solver, step, first, group); });
  }
  PLUMB_DEVICE void move_bodies(Team& team, const StepParameters& step) const {
    each_body_group(team, step, [&](const BodyGroup& group) { integrate_positions(bodies, solver, step, group); });
  }
  PLUMB_DEVICE void finish(Team& team) const {
    const Real dt = parameters->dt;
    team.each(body_count, [&](std::uint32_t i) {
      if (!finish_body(bodies, solver, dt, i)) atomic_add(&counters->nonfinite, 1U);
    });
  }

 private:
  PLUMB_DEVICE BodyGroup group_of(std::uint32_t level, std::uint32_t k) const {
    return {body_groups_of_levels[level * most_groups + k], body_count, solver.levels, level};
  }
  /// f(group) for the bodies that have sub-steps of the step's level, and those that have those of all.
  template <class F>
  PLUMB_DEVICE void each_body_group(Team& team, const StepParameters& step, const F& f) const {
    if (counters->levels.count <= 1) {
      team.each(body_groups(body_count), [&](std::uint32_t group) { f(BodyGroup(group, body_count)); });
    } else {
      const std::uint32_t own = counters->levels.body_groups[step.level];
      team.each(own + counters->levels.body_groups[kEveryLevel],
                [&](std::uint32_t k) { f(k < own ? group_of(step.level, k) : group_of(kEveryLevel, k - own)); });
    }
  }
};

}  // namespace plumb::impulse
