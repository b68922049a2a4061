// The solver "jacobi": all contacts at once, on split bodies.
#pragma once

#include "solver/pass_step.hpp"

namespace plumb::impulse {

/// Impulses as in "si", but a pass solves all contacts at once, none seeing what the others do (Jacobi). That diverges
/// where a body has several contacts, unless it is split into as many parts of equal mass: each contact works on parts
/// of its own, and after the pass a body's parts are put together again, at their mean velocity. Momentum is kept, and
/// the energy of the impulses' error falls in every pass (R. Tonge, F. Benevolenski, A. Voroshilov, "Mass Splitting for
/// Jitter-Free Parallel Rigid Body Simulation", ACM Trans. Graph. 31(4), 2012). The sum over a body's parts goes in the
/// order of its contacts. Joints are solved by colours, between the passes.
template <JointCode kJoints, bool kSurfaceEffects>
using StepInParts = StepInPasses<InParts<kSurfaceEffects>, kJoints>;

}  // namespace plumb::impulse
