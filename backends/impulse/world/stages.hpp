// The stages of a step, in their order (step.cpp). Each enqueues kernels and returns; what it has to do is said here,
// how it does it in the room that it belongs to.
#pragma once

#include "world/step_context.hpp"

namespace plumb::impulse {

/// Nothing is counted yet.
void begin(const StepContext& step);
/// What was enqueued since the last call belongs to this phase of the step.
void end_phase(const StepContext& step, PlumbPhase phase);

/// Boxes of the proxies that move, with what they may need in the step.
void bound(const StepContext& step);
/// Pairs whose boxes overlap and that may touch.
void find_pairs(const StepContext& step);
/// Of pairs with planes, meshes and height fields the triangles that are worth a look.
void midphase(const StepContext& step);

/// Manifolds of the pairs.
void collide(const StepContext& step);
/// Manifolds of what comes to touch in the course of the step, where the scene asks for it.
void find_impacts(const StepContext& step);
/// One manifold for all triangles of a surface that a shape touches from the same side.
void reduce_manifolds(const StepContext& step);
/// What touches, for the host: where it asks for it.
void show_manifolds(const StepContext& step);
/// What the host does not want to touch is gone.
void modify_manifolds(const StepContext& step);
/// Numbers the manifolds, and gives each the impulses of the last step. Sleepers that are touched are found.
void match(const StepContext& step);
/// How many sub-steps each island has, by what its contacts bear.
void choose_substeps(const StepContext& step);
/// No two manifolds of a colour push the same body.
void colour(const StepContext& step);

/// Rows for the solver.
void prepare(const StepContext& step);
/// The state to which a step that makes energy is taken back.
void keep_state(const StepContext& step);
/// Moves the bodies through the step.
void solve(const StepContext& step);
/// What has passed through others in spite of its contacts is put back in front of them.
void clamp(const StepContext& step);
/// Impulses of the contacts for the next step.
void keep_impulses(const StepContext& step);
/// Takes the step back where rows of joints have let go that were counted on, or where it made energy.
void judge(const StepContext& step);

/// Instead of all of these where there is neither a contact nor a joint.
void move_freely(const StepContext& step);

/// For how long bodies have been slow.
void time_rest(const StepContext& step);
/// Rows of state for whoever reads them, and the counters.
void write_output(const StepContext& step);

}  // namespace plumb::impulse
