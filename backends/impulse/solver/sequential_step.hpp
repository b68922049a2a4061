// The solver "si": sequential impulses over the whole step.
#pragma once

#include "solver/pass_step.hpp"

namespace plumb::impulse {

/// Sequential impulses (Catto, "Iterative Dynamics with Temporal Coherence", 2005): one constraint after the other,
/// each seeing what those before it did (projected Gauss-Seidel on accumulated impulses).
template <JointCode kJoints, bool kSurfaceEffects>
using StepSequentially = StepInPasses<InSequence<kSurfaceEffects>, kJoints>;

}  // namespace plumb::impulse
