// Bodies as the solver works on them, in memory.
#pragma once

#include "bodies/body.hpp"
#include "bodies/mechanism.hpp"

namespace plumb::impulse {

/// Velocity of a body before its constraints act, in the sub-step that runs.
struct alignas(4 * sizeof(Real)) FreeVelocity {
  Vec linear;
  Real unused0;
  Vec angular;
  Real unused1;
};

struct SolverBodies {
  Velocity* velocity;
  Displacement* displacement;
  WorldInertia* inertia;
  FreeVelocity* free_velocity;
  bool swings;  ///< angular velocities of bodies that tumble are those of swung_frame.hpp
  Mechanisms mechanisms;
};

}  // namespace plumb::impulse
