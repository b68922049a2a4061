// The way of a body through a step, if nothing meets it.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_parameters.hpp"
#include "math/angle.hpp"

namespace plumb::impulse {

/// At constant velocities.
struct Way {
  Quat orientation;  ///< at the start
  Vec linear, angular;

  [[nodiscard]] PLUMB_HD Quat turn(Real t) const { return turn_by(t * angular); }
};

PLUMB_HD inline Way way_through_step(const Bodies& bodies, const StepParameters& step, std::uint32_t body) {
  const Velocity& velocity = bodies.velocity[body];
  const BodyMass& mass = bodies.mass[body];
  const Vec by_forces = mass.gravity_scale * step.gravity + velocity.inverse_mass * bodies.force[body].force;
  const bool falls = (mass.flags & kBodyDynamic) != 0;
  return {bodies.orientation[body], falls ? velocity.linear + step.dt * by_forces : velocity.linear, velocity.angular};
}
}  // namespace plumb::impulse
