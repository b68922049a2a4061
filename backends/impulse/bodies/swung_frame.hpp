// The axes in which the solver keeps the angular velocity of a body that tumbles.
//
// Contacts are solved in all sub-steps with the inertia and the arms of the step's start, while the body turns on. With
// world axes the two come apart: a thin rod that has turned by 40 degrees is pushed about its long axis where the
// solver sees it pushed across, for a hundredth of the inertia, and gains energy without bound. So angular velocities
// are kept in axes that swing with the body, in which its inertia stays what it was: kinetic energy is what the solver
// believes it to be, whatever the turn, and what takes energy off in those axes takes it off. What a contact pushes is
// turned by the swing instead, an error of first order in the angle, as that of the arm is.
//
// Only the axis swings whose moment differs most from the other two: a turn about it changes next to nothing, and a top
// that spins fast is pushed the way it should be.
#pragma once

#include "bodies/solver_bodies.hpp"
#include "math/angle.hpp"

namespace plumb::impulse {

inline constexpr Real kTumblesFrom = Real(0.05);  ///< rad in a step

/// The turn without its part about a unit axis: the same end of the axis.
PLUMB_HD inline Quat swing_of(const Quat& turn, const Vec& axis) {
  const Real along = dot(vector_part(turn), axis);
  const Real size = sqrt(along * along + turn.w * turn.w);
  if (!(size > 0)) return turn;
  const Vec back = (-along / size) * axis;
  return turn * Quat{back.x, back.y, back.z, turn.w / size};
}

/// At the start of a step. A body tumbles where the scene asks for that, and where it spins so fast that leaving it out
/// shows: angular velocity that is kept makes of it one that wobbles about an axis of its own, and contacts push where
/// it was. What moves as a mechanism is turned by its joints: between two inertias, of the two ways to turn, it would
/// gain energy. Joints that are solved one by one, and mechanisms too large for W, let their bodies tumble as others
/// do.
PLUMB_HD inline bool will_tumble(const Bodies& bodies, Tumbling tumbling, const Mechanisms& mechanisms, Real dt,
                                 std::uint32_t i) {
  if (tumbling == Tumbling::kNobody || (bodies.mass[i].flags & kBodyGyroscopic) == 0) return false;
  if (tumbling == Tumbling::kAll) return true;
  return dt * length(bodies.velocity[i].angular) > kTumblesFrom && !mechanisms.hold(i);
}
/// Within the step.
PLUMB_HD inline bool tumbles(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i) {
  return (bodies.mass[i].flags & kBodyGyroscopic) != 0 &&
         (solver.tumbling == Tumbling::kAll ||
          (solver.tumbling != Tumbling::kNobody && solver.inertia[i].tumbles != 0));
}
/// From the axes in which the solver keeps the velocity of such a body to the world's.
PLUMB_HD inline Quat swing_now(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i) {
  Vec axis = {0, 0, 0};
  axis[odd_axis(bodies.mass[i].inertia)] = 1;
  return swing_of(solver.displacement[i].rotation, rotate(bodies.orientation[i], axis));
}

/// An angular velocity, or what changes one, from the solver's axes to the world's and back.
PLUMB_HD inline Vec to_world(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i, const Vec& angular) {
  return tumbles(bodies, solver, i) ? rotate(swing_now(bodies, solver, i), angular) : angular;
}
PLUMB_HD inline Vec to_solver(const Bodies& bodies, const SolverBodies& solver, std::uint32_t i, const Vec& angular) {
  return tumbles(bodies, solver, i) ? rotate_back(swing_now(bodies, solver, i), angular) : angular;
}

}  // namespace plumb::impulse
