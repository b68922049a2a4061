// How bodies move within a step: forces to velocities, velocities to displacements, and the free rotor.
#pragma once

#include "bodies/axis_locks.hpp"
#include "bodies/body.hpp"
#include "bodies/step_parameters.hpp"
#include "bodies/swung_frame.hpp"
#include "math/angle.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// What forces do to the velocity of a body that they move, m/s2.
PLUMB_HD inline Vec acceleration_by_forces(const Bodies& bodies, const StepParameters& step, std::uint32_t i) {
  return bodies.mass[i].gravity_scale * step.gravity + bodies.velocity[i].inverse_mass * bodies.force[i].force;
}

/// I^-1 in world axes, which is 0 from the start where nothing that is pushed turns, no displacement yet, and what
/// forces do in each sub-step, which is h long.
PLUMB_HD inline void begin_body(const Bodies& bodies, const SolverBodies& solver, const StepParameters& step, Real h,
                                std::uint32_t i) {
  const BodyMass& mass = bodies.mass[i];
  if (bodies.turn) {
    const bool tumbles = will_tumble(bodies, solver.tumbling, solver.mechanisms, step.dt, i);
    solver.inertia[i] = {world_inverse_inertia(bodies.orientation[i], mass.flags, inverse_moments(mass, tumbles)),
                         tumbles ? Real(1) : Real(0), 0};
  }
  solver.displacement[i] = {{0, 0, 0}, 0, {0, 0, 0, 1}};
  if ((mass.flags & kBodyDynamic) == 0) return;
  PLUMB_ASSERT(h > 0);
  PLUMB_ASSERT(bodies.velocity[i].inverse_mass > 0);
  SubstepForces& forces = solver.forces[i];
  forces.linear = h * acceleration_by_forces(bodies, step, i);
  forces.linear_drag = Real(1) / (Real(1) + h * mass.linear_damping);
  if (!bodies.turn) return;
  forces.angular = h * (solver.inertia[i].inverse * bodies.force[i].torque);
  forces.angular_drag = Real(1) / (Real(1) + h * mass.angular_damping);
}

/// Velocity after the forces of a sub-step and, from the second on, after the constraint impulses of the one before:
/// these are what the velocity gained over its free value, so that no pass over the constraints is needed to apply
/// them again.
PLUMB_HD inline void integrate_velocity(const Bodies& bodies, const SolverBodies& solver, const StepParameters& step,
                                        bool first, std::uint32_t i) {
  const std::uint32_t flags = bodies.mass[i].flags;
  if ((flags & kBodyDynamic) == 0) return;
  const SubstepForces& forces = solver.forces[i];
  Velocity& velocity = solver.velocity[i];
  FreeVelocity& free = solver.free_velocity[i];
  const Vec carried = first ? Vec{0, 0, 0} : velocity.linear - free.linear;
  Vec linear = forces.linear_drag * (velocity.linear + forces.linear);
  if ((flags & kBodyLocked) != 0) linear = unlocked(flags, kLockLinear, linear);
  if (bodies.turn) {
    const Vec carried_angular = first ? Vec{0, 0, 0} : velocity.angular - free.angular;
    Vec angular = forces.angular;
    if (tumbles(bodies, solver, i))
      angular = step.h * (solver.inertia[i].inverse * to_solver(bodies, solver, i, bodies.force[i].torque));
    free.angular = forces.angular_drag * (velocity.angular + angular);
    velocity.angular = free.angular + carried_angular;
  }
  free.linear = linear;
  velocity.linear = linear + carried;
}

/// Where a body's turn since the start of the step goes in h seconds without torque, and its angular velocity then.
struct Turned {
  Quat rotation;
  Vec angular_velocity;
};

/// Exact for a constant angular velocity; of a body that tumbles a step of the free rotor, by which the angular
/// velocity changes too.
PLUMB_HD inline Turned turn_freely(const Bodies& bodies, const SolverBodies& solver, const Quat& rotation,
                                   const Vec& angular_velocity, Real h, std::uint32_t i) {
  if ((bodies.mass[i].flags & kBodyTurns) == 0) return {rotation, angular_velocity};
  if (!tumbles(bodies, solver, i)) return {normalized(turn_by(h * angular_velocity) * rotation), angular_velocity};
  const Quat start = bodies.orientation[i];
  const RotorState after = step_free_rotor({rotation * start, angular_velocity}, bodies.mass[i].inertia, h);
  return {normalized(after.orientation * conjugate(start)), after.angular_velocity};
}

/// Moves a body for one sub-step: symplectic Euler for the centre of mass, and a free turn.
PLUMB_HD inline void integrate_position(const Bodies& bodies, const SolverBodies& solver, const StepParameters& step,
                                        std::uint32_t i) {
  const std::uint32_t flags = bodies.mass[i].flags;
  if ((flags & kBodyMoves) == 0) return;
  Velocity& velocity = solver.velocity[i];
  Displacement& displacement = solver.displacement[i];
  if ((flags & kBodyLocked) != 0) velocity.linear = unlocked(flags, kLockLinear, velocity.linear);
  displacement.linear += step.h * velocity.linear;
  if ((flags & kBodyTurns) == 0) return;
  const Vec before = velocity.angular;
  const Vec angular_velocity = to_world(bodies, solver, i, before);
  const Turned turned = turn_freely(bodies, solver, displacement.rotation, angular_velocity, step.h, i);
  displacement.rotation = turned.rotation;
  if (!tumbles(bodies, solver, i)) return;
  velocity.angular = to_solver(bodies, solver, i, turned.angular_velocity);
  solver.free_velocity[i].angular += velocity.angular - before;
}

/// What the host moves goes its way through the sub-steps anew; nothing else is touched.
PLUMB_HD inline void begin_way(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i) {
  if (is_kinematic(bodies.mass[i])) solver.displacement[i] = {{0, 0, 0}, 0, {0, 0, 0, 1}};
}

/// Puts the displacement into the pose; of what the host moves that of the whole step, however many sub-steps there
/// were. A body that came out not finite stays where it was, at rest; returns false.
PLUMB_HD inline bool finish_body(const MovableBodies& bodies, const SolverBodies& solver, Real dt, std::uint32_t i) {
  const std::uint32_t flags = bodies.mass[i].flags;
  if ((flags & kBodyMoves) == 0) return true;
  Displacement& displacement = solver.displacement[i];
  Velocity& velocity = solver.velocity[i];
  if (is_kinematic(bodies.mass[i])) displacement = {dt * velocity.linear, 0, turn_by(dt * velocity.angular)};
  velocity.angular = to_world(bodies, solver, i, velocity.angular);
  if ((flags & kBodyLocked) != 0) {
    displacement.linear = unlocked(flags, kLockLinear, displacement.linear);
    velocity.linear = unlocked(flags, kLockLinear, velocity.linear);
  }
  if (!is_finite(displacement.linear) || !is_finite(velocity.linear) || !is_finite(velocity.angular) ||
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
