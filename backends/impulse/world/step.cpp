// The step: what follows what.
#include "world/stages.hpp"

namespace plumb::impulse {

void enqueue_step(const StepContext& step) {
  enqueue_detection(step);
  enqueue_response(step);
}

void enqueue_detection(const StepContext& step) {
  begin(step);
  if (!step.collides()) return;
  bound(step);
  find_pairs(step);
  validate_pairs(step);
  midphase(step);
  end_phase(step, PLUMB_PHASE_BROAD);

  collide(step);
  find_impacts(step);
  reduce_manifolds(step);
  show_manifolds(step);
}

void enqueue_response(const StepContext& step) {
  if (step.collides()) {
    modify_manifolds(step);
    match(step);
    validate_manifolds(step);
    end_phase(step, PLUMB_PHASE_NARROW);

    choose_substeps(step);
    colour(step);
    validate_colours(step);
    end_phase(step, PLUMB_PHASE_ISLANDS);
  }
  if (step.collides() || step.has_joints()) {
    prepare(step);
    keep_state(step);
    solve(step);
    clamp(step);
    keep_impulses(step);
    judge(step);
    validate_impulses(step);
  } else {
    move_freely(step);
  }
  validate_bodies(step);
  time_rest(step);
  end_phase(step, PLUMB_PHASE_SOLVE);

  write_output(step);
  end_phase(step, PLUMB_PHASE_OUTPUT);
}

}  // namespace plumb::impulse
