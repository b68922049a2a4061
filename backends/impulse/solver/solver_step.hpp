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

  /// Nothing may be done.
  PLUMB_DEVICE bool must_repeat() const { return is_undone(*counters, pair_capacity); }

  /// first: of the step's sub-steps, or each where constraint impulses are not carried over.
  PLUMB_DEVICE void accelerate_bodies(Team& team, const StepParameters& step, bool first) const {
    team.each(body_groups(body_count),
              [&](std::uint32_t group) { integrate_velocities(bodies, solver, step, first, group, body_count); });
  }
  PLUMB_DEVICE void move_bodies(Team& team, const StepParameters& step) const {
    team.each(body_groups(body_count), [&](std::uint32_t group) {
      integrate_positions(bodies, solver, step, features.gyroscopic, group, body_count);
    });
  }
  PLUMB_DEVICE void finish(Team& team) const {
    team.each(body_count, [&](std::uint32_t i) {
      if (!finish_body(bodies, solver, i)) atomic_add(&counters->nonfinite, 1U);
    });
  }
};

}  // namespace plumb::impulse
