// How kLanes bodies come from the solver's rows into registers and back.
#pragma once

#include "bodies/solver_bodies.hpp"
#include "contacts/contact.hpp"

namespace plumb::impulse {

/// Brings in what a body has beside its velocity.
PLUMB_HD inline void load_place(const SolverBodies& bodies, std::uint32_t i, bool moved, SolverBody<Real>& body) {
  body.inverse_inertia = bodies.inertia[i].inverse;
  if (!moved) return;
  const Displacement displacement = bodies.displacement[i];
  body.moved = displacement.linear;
  body.rotated = displacement.rotation;
}

/// Brings bodies in. Without `moved` their displacement is not read (it is not needed).
template <class N>
PLUMB_HD SolverBody<N> load_body(const SolverBodies& bodies, const std::uint32_t* indices, bool moved) {
  if constexpr (sizeof(N) == sizeof(Real)) {
    const Velocity velocity = bodies.velocity[*indices];
    SolverBody<N> body;
    body.linear = velocity.linear;
    body.angular = velocity.angular;
    body.inverse_mass = velocity.inverse_mass;
    load_place(bodies, *indices, moved, body);
    return body;
  } else {
    static_assert(sizeof(Velocity) == sizeof(N) && sizeof(WorldInertia) == sizeof(N) &&
                  sizeof(Displacement) == sizeof(N));
    SolverBody<N> body;
    N numbers[kLanes];
    gather(bodies.velocity, indices, numbers);
    body.linear = {numbers[0], numbers[1], numbers[2]};
    body.inverse_mass = numbers[3];
    body.angular = {numbers[4], numbers[5], numbers[6]};
    gather(bodies.inertia, indices, numbers);
    body.inverse_inertia = {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5]};
    if (moved) {
      gather(bodies.displacement, indices, numbers);
      body.moved = {numbers[0], numbers[1], numbers[2]};
      body.rotated = {numbers[4], numbers[5], numbers[6], numbers[7]};
    }
    return body;
  }
}

/// Brings the velocities before constraints in, of bodies that can be pushed; others move as they do.
template <class N>
PLUMB_HD void load_free_velocity(const SolverBodies& bodies, const std::uint32_t* indices, SolverBody<N>& body) {
  for (std::uint32_t lane = 0; lane < kLanesIn<N>; ++lane) {
    if (!(lane_of(body.inverse_mass, lane) > 0)) continue;
    const FreeVelocity& free = bodies.free_velocity[indices[lane]];
    lane_of(body.linear.x, lane) = free.linear.x;
    lane_of(body.linear.y, lane) = free.linear.y;
    lane_of(body.linear.z, lane) = free.linear.z;
    lane_of(body.angular.x, lane) = free.angular.x;
    lane_of(body.angular.y, lane) = free.angular.y;
    lane_of(body.angular.z, lane) = free.angular.z;
  }
}

/// Writes velocities back, of bodies that can be pushed only.
template <class N>
PLUMB_HD void store_body(const SolverBodies& bodies, const std::uint32_t* indices, const SolverBody<N>& body) {
  if constexpr (sizeof(N) == sizeof(Real)) {
    if (body.inverse_mass > 0) bodies.velocity[*indices] = {body.linear, body.inverse_mass, body.angular, 0};
  } else {
    const N numbers[kLanes] = {body.linear.x,  body.linear.y,  body.linear.z,  body.inverse_mass,
                               body.angular.x, body.angular.y, body.angular.z, N(0)};
    scatter(numbers, body.inverse_mass, bodies.velocity, indices);
  }
}

/// Writes displacements back, of bodies that can be pushed only.
template <class N>
PLUMB_HD void store_displacement(const SolverBodies& bodies, const std::uint32_t* indices, const SolverBody<N>& body) {
  if constexpr (sizeof(N) == sizeof(Real)) {
    if (body.inverse_mass > 0) bodies.displacement[*indices] = {body.moved, 0, body.rotated};
  } else {
    const N numbers[kLanes] = {body.moved.x,   body.moved.y,   body.moved.z,   N(0),
                               body.rotated.x, body.rotated.y, body.rotated.z, body.rotated.w};
    scatter(numbers, body.inverse_mass, bodies.displacement, indices);
  }
}

/// What stands for a mechanism's body while a contact is solved: as heavy, and a ball. What pushes it then is what it
/// gains, to the last digits that its velocity has.
struct Pushed {
  Real per_force, per_torque;  ///< inverse mass and inverse moment

  PLUMB_HD Pushed(const SolverBodies& bodies, std::uint32_t body) : per_force(bodies.velocity[body].inverse_mass) {
    const Sym& inverse = bodies.inertia[body].inverse;
    per_torque = max(max(inverse.xx, inverse.yy), inverse.zz);
  }
};
template <class N>
PLUMB_HD void stand_for_mechanisms(const SolverBodies& bodies, const std::uint32_t* indices, SolverBody<N>& body) {
  for (std::uint32_t lane = 0; lane < kLanesIn<N>; ++lane) {
    if (!bodies.mechanisms.hold(indices[lane])) continue;
    const Pushed pushed(bodies, indices[lane]);
    Sym33<N>& inertia = body.inverse_inertia;
    lane_of(inertia.xx, lane) = lane_of(inertia.yy, lane) = lane_of(inertia.zz, lane) = pushed.per_torque;
    lane_of(inertia.xy, lane) = lane_of(inertia.xz, lane) = lane_of(inertia.yz, lane) = 0;
  }
}
/// A lane of what a vector has gained.
template <class N>
PLUMB_HD Vec gained(const Vec3<N>& now, const Vec3<N>& before, std::uint32_t lane) {
  return {lane_of(now.x, lane) - lane_of(before.x, lane), lane_of(now.y, lane) - lane_of(before.y, lane),
          lane_of(now.z, lane) - lane_of(before.z, lane)};
}
/// Twice the turn from one small turn to another about the same body.
template <class N>
PLUMB_HD Vec gained(const Quat4<N>& now, const Quat4<N>& before, std::uint32_t lane) {
  const auto of_lane = [lane](const Quat4<N>& q) {
    return Quat{lane_of(q.x, lane), lane_of(q.y, lane), lane_of(q.z, lane), lane_of(q.w, lane)};
  };
  return Real(2) * vector_part(of_lane(now) * conjugate(of_lane(before)));
}

/// What pushed the bodies that stood for mechanisms moves these, and an impact takes them back on their way as well: a
/// contact's threads share the bodies. Nothing of their lanes is left for store_body.
template <class N>
PLUMB_HD void push_mechanisms(const SolverBodies& bodies, const std::uint32_t* indices, SolverBody<N>& body,
                              const SolverBody<N>& before, bool impact) {
  const ShareOfBodies share = {static_cast<std::uint32_t>(point_of(0)), kContactThreads};
  for (std::uint32_t lane = 0; lane < kLanesIn<N>; ++lane) {
    const std::uint32_t i = indices[lane];
    if (!bodies.mechanisms.hold(i)) continue;
    const Pushed pushed(bodies, i);
    const Real mass = reciprocal_or_zero(pushed.per_force), moment = reciprocal_or_zero(pushed.per_torque);
    const Vec force = mass * gained(body.linear, before.linear, lane);
    const Vec torque = moment * gained(body.angular, before.angular, lane);
    bodies.mechanisms.push(i, force, torque, bodies.velocity, share);
    lane_of(body.inverse_mass, lane) = 0;
    if (!impact) continue;
    if (share.first == 0) {
      bodies.free_velocity[i].linear += pushed.per_force * force;
      bodies.free_velocity[i].angular += bodies.inertia[i].inverse * torque;
    }
    bodies.mechanisms.displace(i, mass * gained(body.moved, before.moved, lane),
                               moment * gained(body.rotated, before.rotated, lane), bodies.displacement, share);
  }
}

/// What an impact gave a body that can be pushed is part of how it moves freely.
template <class N>
PLUMB_HD void store_free_velocity(const SolverBodies& bodies, const std::uint32_t* indices, const SolverBody<N>& body,
                                  const SolverBody<N>& before) {
  for (std::uint32_t lane = 0; lane < kLanesIn<N>; ++lane) {
    if (!(lane_of(body.inverse_mass, lane) > 0)) continue;
    FreeVelocity& free = bodies.free_velocity[indices[lane]];
    free.linear += gained(body.linear, before.linear, lane);
    free.angular += gained(body.angular, before.angular, lane);
  }
}

/// Contacts are about to push the body at a place of the mechanisms.
PLUMB_HD inline void begin_load(const SolverBodies& bodies, std::uint32_t place) {
  const MechanismBody& of = bodies.mechanisms.bodies[place];
  if (of.count == 0) return;
  const Velocity& velocity = bodies.velocity[of.body];
  ContactLoad& load = bodies.mechanisms.loads[place];
  load.linear = velocity.linear;
  load.angular = velocity.angular;
  load.force = load.torque = {0, 0, 0};
}
/// They have: what is missing to the velocity that the body would have had they pushed it alone.
PLUMB_HD inline void end_load(const SolverBodies& bodies, std::uint32_t place) {
  const MechanismBody& of = bodies.mechanisms.bodies[place];
  if (of.count == 0) return;
  const Velocity& velocity = bodies.velocity[of.body];
  ContactLoad& load = bodies.mechanisms.loads[place];
  load.linear = load.linear + velocity.inverse_mass * load.force - velocity.linear;
  load.angular = load.angular + bodies.inertia[of.body].inverse * load.torque - velocity.angular;
}
/// The body moves as if contacts had pushed it alone, and the joints are to pass that on: they know better, where the
/// bodies have moved, which of them hold, and what they bear.
PLUMB_HD inline void hand_over_load(const SolverBodies& bodies, std::uint32_t place) {
  const MechanismBody& of = bodies.mechanisms.bodies[place];
  if (of.count == 0) return;
  Velocity& velocity = bodies.velocity[of.body];
  velocity.linear += bodies.mechanisms.loads[place].linear;
  velocity.angular += bodies.mechanisms.loads[place].angular;
}

}  // namespace plumb::impulse
