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
    SolverBody<N> body;
    const auto gather = [&](auto& to, const auto* rows) {
      constexpr std::uint32_t kNumbers = sizeof(*rows) / sizeof(Real);
      constexpr std::uint32_t kWanted = sizeof(to) / sizeof(N);
      static_assert(kWanted <= kNumbers);
      auto* lanes = reinterpret_cast<Real*>(&to);
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const auto* numbers = reinterpret_cast<const Real*>(rows + indices[lane]);
        for (std::uint32_t i = 0; i < kWanted; ++i) lanes[i * kLanes + lane] = numbers[i];
      }
    };
    struct VelocityLanes {
      Vec3<N> linear;
      N inverse_mass;
      Vec3<N> angular;
    } velocity;
    gather(velocity, bodies.velocity);
    gather(body.inverse_inertia, bodies.inertia);
    body.linear = velocity.linear;
    body.angular = velocity.angular;
    body.inverse_mass = velocity.inverse_mass;
    if (moved) {
      struct DisplacementLanes {
        Vec3<N> linear;
        N unused;
        Quat4<N> rotation;
      } displacement;
      gather(displacement, bodies.displacement);
      body.moved = displacement.linear;
      body.rotated = displacement.rotation;
    }
    return body;
  }
}

/// Writes velocities back, of bodies that can be pushed only.
template <class N>
PLUMB_HD void store_body(const SolverBodies& bodies, const std::uint32_t* indices, const SolverBody<N>& body) {
  if constexpr (sizeof(N) == sizeof(Real)) {
    if (!(body.inverse_mass > 0)) return;
    Velocity& row = bodies.velocity[*indices];
    row.linear = body.linear;
    row.angular = body.angular;
  } else {
    const auto* linear = reinterpret_cast<const Real*>(&body.linear);
    const auto* angular = reinterpret_cast<const Real*>(&body.angular);
    const auto* mass = reinterpret_cast<const Real*>(&body.inverse_mass);
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (!(mass[lane] > 0)) continue;
      Velocity& row = bodies.velocity[indices[lane]];
      row.linear = {linear[lane], linear[kLanes + lane], linear[2 * kLanes + lane]};
      row.angular = {angular[lane], angular[kLanes + lane], angular[2 * kLanes + lane]};
    }
  }
}

/// Writes displacements back, of bodies that can be pushed only.
template <class N>
PLUMB_HD void store_displacement(const SolverBodies& bodies, const std::uint32_t* indices, const SolverBody<N>& body) {
  constexpr std::uint32_t kHere = sizeof(N) / sizeof(Real);
  for (std::uint32_t lane = 0; lane < kHere; ++lane) {
    if (!(lane_of(body.inverse_mass, lane) > 0)) continue;
    Displacement& row = bodies.displacement[indices[lane]];
    row.linear = {lane_of(body.moved.x, lane), lane_of(body.moved.y, lane), lane_of(body.moved.z, lane)};
    row.rotation = {lane_of(body.rotated.x, lane), lane_of(body.rotated.y, lane), lane_of(body.rotated.z, lane),
                    lane_of(body.rotated.w, lane)};
  }
}

}  // namespace plumb::impulse
