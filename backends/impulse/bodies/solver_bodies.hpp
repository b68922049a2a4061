// Bodies as the solver works on them, in memory.
#pragma once

#include "bodies/body.hpp"
#include "bodies/body_level.hpp"
#include "bodies/mechanism.hpp"

namespace plumb::impulse {

/// Velocity of a body before its constraints act, in the sub-step that runs.
struct alignas(4 * sizeof(Real)) FreeVelocity {
  Vec linear;
  Real unused0;
  Vec angular;
  Real unused1;
};

/// What forces and damping do to a body's velocity in each sub-step of a step.
struct alignas(4 * sizeof(Real)) SubstepForces {
  Vec linear;        ///< added first, m/s
  Real linear_drag;  ///< share that is left then
  Vec angular;       ///< likewise, rad/s
  Real angular_drag;
};

/// Which of the bodies whose principal moments differ turn as a free rotor does; the others keep their angular
/// velocity.
enum class Tumbling : std::uint8_t { kNobody, kFastOnes, kAll };

struct SolverBodies {
  Velocity* velocity;
  Displacement* displacement;
  WorldInertia* inertia;
  FreeVelocity* free_velocity;
  SubstepForces* forces;  ///< of dynamic bodies
  Tumbling tumbling;
  Mechanisms mechanisms;
  BodyLevels levels;
};

}  // namespace plumb::impulse
