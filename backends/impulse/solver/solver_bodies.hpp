// Bodies as the solver works on them: rows in memory, and how kLanes of them come into registers and back.
#pragma once

#include "body.hpp"
#include "constraints/contact.hpp"

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
};

/// Brings bodies in. Without `moved` their displacement is not read (it is not needed).
template <class N>
PLUMB_HD SolverBody<N> load_body(const SolverBodies& bodies, const std::uint32_t* indices, bool moved) {
  if constexpr (sizeof(N) == sizeof(Real)) {
    const Velocity velocity = bodies.velocity[*indices];
    SolverBody<N> body;
    body.linear = velocity.linear;
    body.angular = velocity.angular;
    body.inverse_mass = velocity.inverse_mass;
    body.inverse_inertia = bodies.inertia[*indices].inverse;
    if (moved) {
      const Displacement displacement = bodies.displacement[*indices];
      body.moved = displacement.linear;
      body.rotated = displacement.rotation;
    }
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
    __builtin_memcpy(&body.inverse_inertia, numbers, sizeof body.inverse_inertia);
    if (moved) {
      gather(bodies.displacement, indices, numbers);
      body.moved = {numbers[0], numbers[1], numbers[2]};
      body.rotated = {numbers[4], numbers[5], numbers[6], numbers[7]};
    }
    return body;
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

}  // namespace plumb::impulse
