// The contact constraint: no approach along the normal (lambda >= 0), Coulomb friction in the plane across it.
//
// Velocity constraint J V = 0 with J = [-n, -(ra x n), n, rb x n], solved by sequential impulses: each point in turn
// takes the impulse that makes its relative velocity right, accumulated impulses are clamped (Catto, "Iterative
// Dynamics with Temporal Coherence", 2005). Overlap is taken back softly, by a damped spring integrated implicitly
// (Catto, "Soft Constraints", GDC 2011; "Solver2D", 2024).
//
// Friction is solved for both tangents at once. What would stop the slip is taken as it is where it lies within the
// circle of radius mu times the current normal impulse of the same point. Where it does not, the point slides, and the
// impulse takes a projected step against the slip: only then is it opposite to the slip when it no longer changes
// (maximum dissipation). The impulse that stops the slip, cut to the circle, is not: it leans by the ratio of the
// effective masses, and a cube on a slope slides by itself at 94 % of its friction.
#pragma once

#include "body.hpp"
#include "constraints/contact_rows.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

/// A body, or kLanes of them, while a constraint is being solved.
template <class N>
struct SolverBody {
  Vec3<N> linear, angular;
  N inverse_mass;
  Sym33<N> inverse_inertia;
  Vec3<N> moved;     ///< Displacement::linear
  Quat4<N> rotated;  ///< Displacement::rotation
};

template <class N>
PLUMB_HD Vec3<N> velocity_at(const SolverBody<N>& body, const Vec3<N>& arm) {
  return body.linear + cross(body.angular, arm);
}
template <class N>
PLUMB_HD void push(SolverBody<N>& body, const Vec3<N>& arm, const Vec3<N>& impulse) {
  body.linear += body.inverse_mass * impulse;
  body.angular += body.inverse_inertia * cross(arm, impulse);
}
/// How far the end of an arm has moved since the step began: the body's own way and the turn of the arm.
template <class N>
PLUMB_HD Vec3<N> displacement_at(const SolverBody<N>& body, const Vec3<N>& arm) {
  const Vec3<N> u = vector_part(body.rotated);
  const Vec3<N> t = cross(u, arm);
  const Vec3<N> s = t + t;
  return body.moved + (body.rotated.w * s + cross(u, s));
}

/// What a pass over the contacts is to do.
struct ContactPass {
  Softness between_movers, against_fixed;
  Real inverse_h;          ///< 1/s
  Real push_speed;         ///< m/s
  bool take_back_overlap;  ///< with the soft bias; without it the pass relaxes what the bias has pushed too far
  bool friction;
  bool note_impacts;  ///< write down how fast a point closed when it was first pushed in this step
  bool add_up;        ///< add the impulses to those of the whole step
};

/// The normal impulses of a manifold (or of kLanes of them), point after point. `points` is the largest number among
/// the lanes.
///
/// A point that is apart may close its gap within the sub-step and no more. One that overlaps is taken back softly in
/// the first pass; the second, after the positions have moved, only sees to it that nothing approaches, so that what
/// the bias pushed does not stay as velocity.
template <class N>
PLUMB_HD void solve_normals(const RowAccess<N>& row, int points, SolverBody<N>& a, SolverBody<N>& b,
                            const ContactPass& pass) {
  const Vec3<N> n = row.vector(kNormal);
  const N zero = N(0), one = N(1);
  const auto movers = min(a.inverse_mass, b.inverse_mass) > zero;
  const Softness &soft = pass.between_movers, &hard = pass.against_fixed;
  const N rate = select(movers, N(soft.bias_rate), N(hard.bias_rate));
  const N mass_scale = select(movers, N(soft.mass_scale), N(hard.mass_scale));
  const N impulse_scale = select(movers, N(soft.impulse_scale), N(hard.impulse_scale));
  for (int p = 0; p < points; ++p) {
    const Vec3<N> ra = row.vector(point_field(p, kArmA)), rb = row.vector(point_field(p, kArmB));
    const N speed = dot(velocity_at(b, rb) - velocity_at(a, ra), n);
    const N old = row.get(point_field(p, kNormalImpulse));
    const N mass = row.get(point_field(p, kNormalMass));
    N wanted;
    if (pass.take_back_overlap) {
      const N separation =
          row.get(point_field(p, kSeparation)) + dot(displacement_at(b, rb) - displacement_at(a, ra), n);
      const auto apart = separation > zero;
      const N gap_speed = select(apart, separation * N(pass.inverse_h), zero);
      row.put(point_field(p, kGapSpeed), gap_speed);
      const N bias = select(apart, gap_speed, max(rate * separation, N(-pass.push_speed)));
      wanted = old - mass * select(apart, one, mass_scale) * (speed + bias) - select(apart, zero, impulse_scale) * old;
    } else {
      wanted = old - mass * (speed + row.get(point_field(p, kGapSpeed)));
    }
    const N total = max(wanted, zero);
    row.put(point_field(p, kNormalImpulse), total);
    if (pass.note_impacts) {
      const N noted = row.get(point_field(p, kImpactSpeed));
      row.put(point_field(p, kImpactSpeed), select(total > zero && noted > zero, min(speed, zero), noted));
    }
    if (pass.add_up) row.put(point_field(p, kStepImpulse), row.get(point_field(p, kStepImpulse)) + total);
    const Vec3<N> impulse = (total - old) * n;
    push(a, ra, -impulse);
    push(b, rb, impulse);
  }
}

/// The friction impulses of a manifold, both tangents of a point at once.
template <class N>
PLUMB_HD void solve_friction(const RowAccess<N>& row, int points, SolverBody<N>& a, SolverBody<N>& b,
                             const ContactPass& pass) {
  const Vec3<N> t1 = row.vector(kTangent);
  const Vec3<N> t2 = cross(row.vector(kNormal), t1);
  const N friction = row.get(kFriction);
  for (int p = 0; p < points; ++p) {
    const Vec3<N> ra = row.vector(point_field(p, kArmA)), rb = row.vector(point_field(p, kArmB));
    const Vec3<N> slip = velocity_at(b, rb) - velocity_at(a, ra);
    const N v1 = dot(slip, t1), v2 = dot(slip, t2);
    const N m11 = row.get(point_field(p, kTangentMass)), m12 = row.get(point_field(p, kTangentMass + 1)),
            m22 = row.get(point_field(p, kTangentMass + 2));
    const N old1 = row.get(point_field(p, kTangentImpulse)), old2 = row.get(point_field(p, kTangentImpulse + 1));
    const N most = friction * row.get(point_field(p, kNormalImpulse));
    const N stop1 = old1 - (m11 * v1 + m12 * v2), stop2 = old2 - (m12 * v1 + m22 * v2);
    const N step = row.get(point_field(p, kTangentStep));
    const N slide1 = old1 - step * v1, slide2 = old2 - step * v2;
    const N size = sqrt(slide1 * slide1 + slide2 * slide2);
    const N cut = select(size > most, most / max(size, N(Real(1e-30))), N(1));
    const auto slides = stop1 * stop1 + stop2 * stop2 > most * most;
    const N new1 = select(slides, cut * slide1, stop1), new2 = select(slides, cut * slide2, stop2);
    row.put(point_field(p, kTangentImpulse), new1);
    row.put(point_field(p, kTangentImpulse + 1), new2);
    if (pass.add_up) {
      row.put(point_field(p, kStepImpulse + 1), row.get(point_field(p, kStepImpulse + 1)) + new1);
      row.put(point_field(p, kStepImpulse + 2), row.get(point_field(p, kStepImpulse + 2)) + new2);
    }
    const Vec3<N> impulse = (new1 - old1) * t1 + (new2 - old2) * t2;
    push(a, ra, -impulse);
    push(b, rb, impulse);
  }
}

/// Applies the impulses that the last step ended with (warm starting).
template <class N>
PLUMB_HD void warm_start_contact(const RowAccess<N>& row, int points, SolverBody<N>& a, SolverBody<N>& b) {
  const Vec3<N> n = row.vector(kNormal), t1 = row.vector(kTangent);
  const Vec3<N> t2 = cross(n, t1);
  for (int p = 0; p < points; ++p) {
    const Vec3<N> impulse = row.get(point_field(p, kNormalImpulse)) * n +
                            row.get(point_field(p, kTangentImpulse)) * t1 +
                            row.get(point_field(p, kTangentImpulse + 1)) * t2;
    push(a, row.vector(point_field(p, kArmA)), -impulse);
    push(b, row.vector(point_field(p, kArmB)), impulse);
  }
}

/// Newton's restitution: a point that closed faster than `slowest` and was pushed leaves with e times that speed.
template <class N>
PLUMB_HD void bounce_contact(const RowAccess<N>& row, int points, SolverBody<N>& a, SolverBody<N>& b, Real slowest) {
  const Vec3<N> n = row.vector(kNormal);
  const N restitution = row.get(kRestitution);
  for (int p = 0; p < points; ++p) {
    const N impact = row.get(point_field(p, kImpactSpeed));
    const Vec3<N> ra = row.vector(point_field(p, kArmA)), rb = row.vector(point_field(p, kArmB));
    const N speed = dot(velocity_at(b, rb) - velocity_at(a, ra), n);
    const N old = row.get(point_field(p, kNormalImpulse));
    const N wanted = max(old - row.get(point_field(p, kNormalMass)) * (speed + restitution * impact), N(0));
    const N total = select(impact < N(-slowest) && restitution > N(0), wanted, old);
    row.put(point_field(p, kNormalImpulse), total);
    row.put(point_field(p, kStepImpulse), row.get(point_field(p, kStepImpulse)) + (total - old));
    const Vec3<N> impulse = (total - old) * n;
    push(a, ra, -impulse);
    push(b, rb, impulse);
  }
}

}  // namespace plumb::impulse
