// How bodies move within a step: forces to velocities, velocities to displacements, and the free rotor.
#pragma once

#include "body.hpp"
#include "math/angle.hpp"
#include "solver/solver_bodies.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

/// I^-1 in world axes, and no displacement yet.
PLUMB_HD inline void begin_body(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i) {
  const Mat axes = to_matrix(bodies.orientation[i]);
  solver.inertia[i] = {rotated_diagonal(axes, bodies.mass[i].inverse_inertia), {0, 0}};
  solver.displacement[i] = {{0, 0, 0}, 0, {0, 0, 0, 1}};
}

/// Velocity after the forces of a sub-step and, from the second on, after the constraint impulses of the one before:
/// these are what the velocity gained over its free value, so that no pass over the constraints is needed to apply
/// them again.
PLUMB_HD inline void integrate_velocity(const Bodies& bodies, const SolverBodies& solver, const StepParameters& step,
                                        bool first, std::uint32_t i) {
  const BodyMass& mass = bodies.mass[i];
  if ((mass.flags & kBodyDynamic) == 0) return;
  Velocity& velocity = solver.velocity[i];
  FreeVelocity& free = solver.free_velocity[i];
  const Vec carried_linear = first ? Vec{0, 0, 0} : velocity.linear - free.linear;
  const Vec carried_angular = first ? Vec{0, 0, 0} : velocity.angular - free.angular;
  const Vec acceleration = mass.gravity_scale * step.gravity + velocity.inverse_mass * bodies.force[i].force;
  const Real drag = Real(1) / (Real(1) + step.h * mass.linear_damping);
  const Real angular_drag = Real(1) / (Real(1) + step.h * mass.angular_damping);
  free.linear = drag * (velocity.linear + step.h * acceleration);
  free.angular = angular_drag * (velocity.angular + step.h * (solver.inertia[i].inverse * bodies.force[i].torque));
  velocity.linear = free.linear + carried_linear;
  velocity.angular = free.angular + carried_angular;
}

/// Moves a body for one sub-step. Symplectic Euler for the centre of mass; the turn is exact for a constant angular
/// velocity, and for a body whose principal moments differ it is a step of the free rotor, by which the angular
/// velocity changes too.
PLUMB_HD inline void integrate_position(const Bodies& bodies, const SolverBodies& solver, const StepParameters& step,
                                        bool gyroscopic, std::uint32_t i) {
  const std::uint32_t flags = bodies.mass[i].flags;
  if ((flags & kBodyMoves) == 0) return;
  Velocity& velocity = solver.velocity[i];
  Displacement& displacement = solver.displacement[i];
  displacement.linear += step.h * velocity.linear;
  if ((flags & kBodyTurns) == 0) return;
  if (gyroscopic && (flags & kBodyGyroscopic) != 0) {
    const Quat start = bodies.orientation[i];
    const Quat orientation = displacement.rotation * start;
    const Vec before = velocity.angular;
    const RotorState after = step_free_rotor({orientation, before}, bodies.mass[i].inertia, step.h);
    displacement.rotation = normalized(after.orientation * conjugate(start));
    velocity.angular = after.angular_velocity;
    solver.free_velocity[i].angular += velocity.angular - before;
    return;
  }
  displacement.rotation = normalized(turn_by(step.h * velocity.angular) * displacement.rotation);
}

/// Puts the displacement into the pose. A body that came out not finite stays where it was, at rest; returns false.
PLUMB_HD inline bool finish_body(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i) {
  const std::uint32_t flags = bodies.mass[i].flags;
  if ((flags & kBodyMoves) == 0) return true;
  const Displacement& displacement = solver.displacement[i];
  Velocity& velocity = solver.velocity[i];
  const auto finite = [](const Vec& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); };
  if (!finite(displacement.linear) || !finite(velocity.linear) || !finite(velocity.angular) ||
      !is_finite(displacement.rotation.w)) {
    if ((flags & kBodyDynamic) != 0) velocity.linear = velocity.angular = {0, 0, 0};
    return false;
  }
  bodies.position[i] = moved(bodies.position[i], displacement.linear);
  if ((flags & kBodyTurns) != 0) bodies.orientation[i] = normalized(displacement.rotation * bodies.orientation[i]);
  // + 0 turns -0 into 0: lanes that stand for no point have added either, and hashes must not see which.
  const Vec zero = {0, 0, 0};
  if ((flags & kBodyDynamic) != 0) {
    velocity.linear = velocity.linear + zero;
    velocity.angular = velocity.angular + zero;
  }
  return true;
}

}  // namespace plumb::impulse
