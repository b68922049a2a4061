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
};

/// What a point's normal impulse has to bring about in a pass.
template <class N>
struct PointAim {
  N bias;  ///< wanted speed along the normal, with the other sign, m/s
  N mass;  ///< effective and softened, kg
  N leak;  ///< share of the impulse that softness takes off again
  N give;  ///< leak over mass: speed that the impulse may leave, m/s per N s
  N open;  ///< above 0: the point is apart; see kOpen
};
template <class N>
using ManifoldAim = PointAim<N>[kManifoldPoints];

/// A point that is apart may close its gap within the sub-step and no more. One that overlaps is taken back softly in
/// the first pass. The second, after the positions have moved, only sees to it that nothing that touches approaches, so
/// that what the bias pushed does not stay as velocity.
template <class N>
PLUMB_HD void aim_normals(const RowAccess<N>& row, int points, const SolverBody<N>& a, const SolverBody<N>& b,
                          const ContactPass& pass, ManifoldAim<N>& aims) {
  const N zero = N(0), one = N(1);
  const Vec3<N> n = row.vector(kNormal);
  const auto movers = min(a.inverse_mass, b.inverse_mass) > zero;
  const Softness &between = pass.between_movers, &fixed = pass.against_fixed;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    PointAim<N>& aim = aims[p];
    aim = {zero, zero, zero, zero, zero};
    if (p >= points) continue;
    aim.mass = row.get(point_field(p, kNormalMass));
    if (!pass.take_back_overlap) {
      aim.open = row.get(point_field(p, kOpen));
      aim.bias = aim.open;
      continue;
    }
    const Vec3<N> ra = row.vector(point_field(p, kArmA)), rb = row.vector(point_field(p, kArmB));
    const N separation = row.get(point_field(p, kSeparation)) + dot(displacement_at(b, rb) - displacement_at(a, ra), n);
    const auto apart = separation > zero;
    const N rate = select(movers, N(between.bias_rate), N(fixed.bias_rate));
    aim.bias = select(apart, separation * N(pass.inverse_h), max(rate * separation, N(-pass.push_speed)));
    aim.mass = aim.mass * select(apart, one, select(movers, N(between.mass_scale), N(fixed.mass_scale)));
    aim.leak = select(apart, zero, select(movers, N(between.impulse_scale), N(fixed.impulse_scale)));
    aim.give =
        select(apart, zero, select(movers, N(between.give), N(fixed.give)) * row.get(point_field(p, kNormalGive)));
    aim.open = select(apart && aim.mass > zero, N(kHuge), zero);
  }
}

/// Speed with which b leaves a at a point.
template <class N>
PLUMB_HD N leaving_speed(const RowAccess<N>& row, int p, const Vec3<N>& n, const SolverBody<N>& a,
                         const SolverBody<N>& b) {
  return dot(velocity_at(b, row.vector(point_field(p, kArmB))) - velocity_at(a, row.vector(point_field(p, kArmA))), n);
}

/// Gives a point a new impulse and lets it act, in the lanes of `chosen`. speed: with which b leaves a before.
template <class N, class M>
PLUMB_HD void put_normal(const RowAccess<N>& row, int p, const Vec3<N>& n, SolverBody<N>& a, SolverBody<N>& b,
                         const M& chosen, const N& wanted, const N& open, const N& speed, const ContactPass& pass) {
  const N zero = N(0);
  const N old = row.get(point_field(p, kNormalImpulse));
  const N total = select(chosen, wanted, old);
  row.put(point_field(p, kNormalImpulse), total);
  if (pass.take_back_overlap) row.put(point_field(p, kOpen), select(total > zero, zero, open));
  if (pass.note_impacts) {
    const N noted = row.get(point_field(p, kImpactSpeed));
    const auto first = chosen && total > zero && noted > zero;
    row.put(point_field(p, kImpactSpeed), select(first, min(speed, zero), noted));
  }
  const Vec3<N> impulse = (total - old) * n;
  push(a, row.vector(point_field(p, kArmA)), -impulse);
  push(b, row.vector(point_field(p, kArmB)), impulse);
}

/// All points of a manifold at once, by the inverse of their matrix: exact where every point touches and none would
/// have to pull (after the block solver of Box2D: Catto, "Modeling and Solving Constraints", GDC 2009). Returns the
/// lanes where that holds; in the others nothing is changed.
template <class N>
PLUMB_HD auto solve_normal_block(const RowAccess<N>& row, int points, const Vec3<N>& n, const ManifoldAim<N>& aims,
                                 SolverBody<N>& a, SolverBody<N>& b, const ContactPass& pass) {
  const N zero = N(0);
  N speed[kManifoldPoints], residual[kManifoldPoints], total[kManifoldPoints];
  auto holds = zero < N(1);
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    speed[p] = residual[p] = total[p] = zero;
    if (p >= points) continue;
    speed[p] = leaving_speed(row, p, n, a, b);
    total[p] = row.get(point_field(p, kNormalImpulse));
    residual[p] = select(aims[p].mass > zero, speed[p] + aims[p].bias + aims[p].give * total[p], zero);
    holds = holds && !(aims[p].mass > zero && aims[p].open > N(kHuge / 2));
  }
  std::uint32_t field = kBlockInverse;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    PLUMB_UNROLL
    for (int q = p; q < kManifoldPoints; ++q, ++field) {
      const N inverse = row.get(field);
      total[p] = total[p] - inverse * residual[q];
      if (q != p) total[q] = total[q] - inverse * residual[p];
    }
  }
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) holds = holds && !(total[p] < zero);
  if (!any(holds)) return holds;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    if (p >= points) continue;
    put_normal(row, p, n, a, b, holds, total[p], aims[p].open, speed[p], pass);
  }
  return holds;
}

/// The normal impulses of a manifold (or of kLanes of them). `points` is the largest number among the lanes.
template <class N>
PLUMB_HD void solve_normals(const RowAccess<N>& row, int points, const ManifoldAim<N>& aims, SolverBody<N>& a,
                            SolverBody<N>& b, const ContactPass& pass) {
  const Vec3<N> n = row.vector(kNormal);
  const auto left = !solve_normal_block(row, points, n, aims, a, b, pass);
  if (!any(left)) return;
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    if (p >= points) continue;
    const PointAim<N>& aim = aims[p];
    const N speed = leaving_speed(row, p, n, a, b);
    const N old = row.get(point_field(p, kNormalImpulse));
    const N total = max(old - aim.mass * (speed + aim.bias) - aim.leak * old, N(0));
    put_normal(row, p, n, a, b, left, total, aim.open, speed, pass);
  }
}

/// The same for a pass that comes to the normals once.
template <class N>
PLUMB_HD void solve_normals(const RowAccess<N>& row, int points, SolverBody<N>& a, SolverBody<N>& b,
                            const ContactPass& pass) {
  ManifoldAim<N> aims;
  aim_normals(row, points, a, b, pass, aims);
  solve_normals(row, points, aims, a, b, pass);
}

/// Adds the impulses of a sub-step that is done to those of the step.
template <class N>
PLUMB_HD void add_up_impulses(const RowAccess<N>& row, int points) {
  for (int p = 0; p < points; ++p)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t sum = point_field(p, kStepImpulse + i);
      row.put(sum, row.get(sum) + row.get(point_field(p, kNormalImpulse + i)));
    }
}

/// The friction impulses of a manifold, both tangents of a point at once.
template <class N>
PLUMB_HD void solve_friction(const RowAccess<N>& row, int points, SolverBody<N>& a, SolverBody<N>& b) {
  const Vec3<N> t1 = row.vector(kTangent);
  const Vec3<N> t2 = cross(row.vector(kNormal), t1);
  const N friction = row.get(kFriction);
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    if (p >= points) continue;
    const Vec3<N> ra = row.vector(point_field(p, kArmA)), rb = row.vector(point_field(p, kArmB));
    const Vec3<N> slip = velocity_at(b, rb) - velocity_at(a, ra);
    const N v1 = dot(slip, t1), v2 = dot(slip, t2);
    const N m11 = row.get(point_field(p, kTangentMass)), m12 = row.get(point_field(p, kTangentMass + 1)),
            m22 = row.get(point_field(p, kTangentMass + 2));
    const N old1 = row.get(point_field(p, kTangentImpulse)), old2 = row.get(point_field(p, kTangentImpulse + 1));
    const N most = friction * row.get(point_field(p, kNormalImpulse));
    const N stop1 = old1 - (m11 * v1 + m12 * v2), stop2 = old2 - (m12 * v1 + m22 * v2);
    const auto slides = stop1 * stop1 + stop2 * stop2 > most * most;
    N new1 = stop1, new2 = stop2;
    if (any(slides)) {
      const N step = row.get(point_field(p, kTangentStep));
      const N slide1 = old1 - step * v1, slide2 = old2 - step * v2;
      const N size = sqrt(slide1 * slide1 + slide2 * slide2);
      const N cut = select(size > most, most / max(size, N(Real(1e-30))), N(1));
      new1 = select(slides, cut * slide1, stop1);
      new2 = select(slides, cut * slide2, stop2);
    }
    row.put(point_field(p, kTangentImpulse), new1);
    row.put(point_field(p, kTangentImpulse + 1), new2);
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
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    if (p >= points) continue;
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
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) {
    if (p >= points) continue;
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
