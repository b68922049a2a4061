// Normal impulses of a contact: overlap is taken back softly, by a damped spring integrated implicitly (Catto, "Soft
// Constraints", GDC 2011; "Solver2D", 2024).
#pragma once

#include "constraints/contact.hpp"

namespace plumb::impulse {

/// How a pass over the contacts takes overlap back.
struct ContactSoftness {
  Softness between_movers, against_fixed;
  Real inverse_h;   ///< 1/s
  Real push_speed;  ///< m/s
};

/// What a point's normal impulse has to bring about in a pass.
template <class N>
struct PointAim {
  N bias;  ///< wanted speed along the normal, with the other sign, m/s
  N mass;  ///< effective and softened, kg
  N leak;  ///< share of the impulse that softness takes off again
  N give;  ///< leak over mass: speed that the impulse may leave, m/s per N s
};
template <class N>
using ManifoldAim = PointAim<N>[kManifoldPoints];

/// A point that is apart may close its gap within the sub-step and no more; one that overlaps is taken back softly.
/// Notes in `open` which points are apart.
template <int P, class N>
PLUMB_HD void aim_softly(Contact<N>& contact, const SolverBody<N>& a, const SolverBody<N>& b,
                         const ContactSoftness& softness, ManifoldAim<N>& aims) {
  const N zero = N(0), one = N(1);
  const Vec3<N> n = contact.normal;
  const auto movers = min(a.inverse_mass, b.inverse_mass) > zero;
  const Softness &between = softness.between_movers, &fixed = softness.against_fixed;
  const N at_centre = dot(displacement_at(b, contact.centre_b) - displacement_at(a, contact.centre_a), n);
  // n . (turn of b - turn of a) arm, by the turns' transposes
  const Vec3<N> by_arm = change_by_turn(conjugate(b.rotated), n) - change_by_turn(conjugate(a.rotated), n);
  const N rate = select(movers, N(between.bias_rate), N(fixed.bias_rate));
  const N mass_scale = select(movers, N(between.mass_scale), N(fixed.mass_scale));
  const N impulse_scale = select(movers, N(between.impulse_scale), N(fixed.impulse_scale));
  const N give = select(movers, N(between.give), N(fixed.give));
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    ContactPoint<N>& point = contact.points[p];
    PointAim<N>& aim = aims[p];
    const N separation = point.separation + (at_centre + dot(point.arm, by_arm));
    const auto apart = separation > zero;
    aim.bias = select(apart, separation * N(softness.inverse_h), max(rate * separation, N(-softness.push_speed)));
    aim.mass = point.normal_mass * select(apart, one, mass_scale);
    aim.leak = select(apart, zero, impulse_scale);
    aim.give = select(apart, zero, give * point.normal_give);
    point.open = select(apart && point.normal_mass > zero, N(kHuge), zero);
  }
}

/// Without softness: each point may approach with the speed that `open` says. In a pass that comes after the positions
/// have moved, so that what aim_softly pushed does not stay as velocity, that is 0, or any where the point is apart.
template <int P, class N>
PLUMB_HD void aim_hard(const Contact<N>& contact, ManifoldAim<N>& aims) {
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) aims[p] = {contact.points[p].open, contact.points[p].normal_mass, N(0), N(0)};
}

/// Speeds with which b leaves a at the points, and the impulses that a pass has found for them.
template <int P, class N>
struct NormalPass {
  N speed[P], total[P];
};

/// All points of a manifold at once, by the inverse of their matrix: exact where every point touches and none would
/// have to pull (after the block solver of Box2D: Catto, "Modeling and Solving Constraints", GDC 2009). Returns the
/// lanes where that holds. The points of a face that come down touch together, too: one after the other they would turn
/// it. Of an edge they do not, measured in impacts with friction.
template <int P, class N>
PLUMB_HD auto solve_normal_block(const Contact<N>& contact, const ManifoldAim<N>& aims, NormalPass<P, N>& pass) {
  const N zero = N(0);
  N residual[P];
  const auto is_face = (P > 2 ? contact.points[P > 2 ? 2 : 0].normal_mass : zero) > zero;
  auto holds = zero < N(1);
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    const ContactPoint<N>& point = contact.points[p];
    pass.total[p] = point.impulse[0];
    const auto there = point.normal_mass > zero;
    residual[p] = select(there, pass.speed[p] + aims[p].bias + aims[p].give * pass.total[p], zero);
    holds = holds && !(there && select(is_face, aims[p].bias, point.open) > N(kHuge / 2));
  }
  int field = 0;
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    PLUMB_UNROLL
    for (int q = p; q < P; ++q) {
      const N inverse = contact.block_inverse[field + (q - p)];
      pass.total[p] = pass.total[p] - inverse * residual[q];
      if (q != p) pass.total[q] = pass.total[q] - inverse * residual[p];
    }
    field += kManifoldPoints - p;
  }
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) holds = holds && !(pass.total[p] < zero);
  return holds;
}

/// Point by point, in the lanes of `left`: each is clamped, and what it takes changes the speeds of those after it.
template <int P, class N, class M>
PLUMB_HD void solve_normal_points(const Contact<N>& contact, const ManifoldAim<N>& aims, const M& left,
                                  NormalPass<P, N>& pass) {
  N speed[P];
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) speed[p] = pass.speed[p];
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    const N old = contact.points[p].impulse[0];
    const N total = max(old - aims[p].mass * (speed[p] + aims[p].bias) - aims[p].leak * old, N(0));
    pass.total[p] = select(left, total, pass.total[p]);
    PLUMB_UNROLL
    for (int q = p + 1; q < P; ++q) speed[q] = speed[q] + contact.coupling[coupling_of(p, q)] * (total - old);
  }
}

/// Impulses along the normal act together: one push at the mean of the points, one torque.
template <int P, class N>
PLUMB_HD void push_normals(const Contact<N>& contact, const N (&change)[P], SolverBody<N>& a, SolverBody<N>& b) {
  const Vec3<N> n = contact.normal;
  N sum = change[0];
  Vec3<N> lever = change[0] * contact.points[0].arm;
  PLUMB_UNROLL
  for (int p = 1; p < P; ++p) {
    sum = sum + change[p];
    lever += change[p] * contact.points[p].arm;
  }
  const Vec3<N> impulse = sum * n;
  a.linear -= a.inverse_mass * impulse;
  a.angular -= a.inverse_inertia * cross(sum * contact.centre_a + lever, n);
  b.linear += b.inverse_mass * impulse;
  b.angular += b.inverse_inertia * cross(sum * contact.centre_b + lever, n);
}

/// The speed with which a point touches that has come to be pushed while it is apart by s: its gap closes after the
/// share s / (h |v|) of the sub-step, which is bias over speed. Half of the sub-step's pull that is in v already comes
/// too early, for velocities are half a sub-step ahead of positions: by the conservation of energy the point touches
/// with |v| - g h / 2 + g s / |v|. A body that leaves is pulled back half of g h too much in its turn, so that this
/// half is left out here, and e = 1 brings it back to where it came from.
template <class N>
PLUMB_HD N speed_at_touch(const N& pull, const PointAim<N>& aim, const N& speed) {
  const N zero = N(0), closing = -speed;
  const auto apart = aim.bias > zero && aim.bias < closing;
  const N share = aim.bias / max(closing, N(Real(1e-30)));
  return min(speed + select(apart, share, zero) * pull, zero);
}

/// The first time in a step that one of the points is pushed, the speeds of all are noted: they hit together, though
/// one of them may be pushed a sub-step later, when the blow on the first has changed its speed. From its own speed it
/// would leave with energy that nobody put in. The noted speed of a point that is not pushed yet waits as kWaits less
/// itself.
template <int P, class N>
PLUMB_HD void note_impact_speeds(Contact<N>& contact, const ManifoldAim<N>& aims, const NormalPass<P, N>& pass) {
  const N zero = N(0), one = N(1), waits = N(kWaits);
  N pushed = zero;
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p)
    pushed = select(pass.total[p] > zero && contact.points[p].impact_speed > zero, one, pushed);
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    N& noted = contact.points[p].impact_speed;
    const N came = speed_at_touch(contact.pull, aims[p], pass.speed[p]);
    noted = select(pushed > zero && noted > zero && noted < waits, waits - came, noted);
    noted = select(pass.total[p] > zero && noted > zero, waits - noted, noted);
  }
}

/// The normal impulses of a manifold: as a block, and point by point in the lanes where a block does not do. The first
/// time in a step that a point is pushed, its speed is noted for restitution.
template <int P, class N>
PLUMB_HD void solve_normals(Contact<N>& contact, const ManifoldAim<N>& aims, SolverBody<N>& a, SolverBody<N>& b,
                            bool note_impacts) {
  const Vec3<N> n = contact.normal;
  const N at_centre = dot(velocity_at(b, contact.centre_b) - velocity_at(a, contact.centre_a), n);
  const Vec3<N> by_arm = cross(n, b.angular - a.angular);
  NormalPass<P, N> pass;
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) pass.speed[p] = at_centre + dot(contact.points[p].arm, by_arm);

  const auto left = !solve_normal_block<P>(contact, aims, pass);
  if (any(left)) solve_normal_points<P>(contact, aims, left, pass);

  N change[P];
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    ContactPoint<N>& point = contact.points[p];
    change[p] = pass.total[p] - point.impulse[0];
    point.impulse[0] = pass.total[p];
  }
  if (note_impacts) note_impact_speeds<P>(contact, aims, pass);
  push_normals<P>(contact, change, a, b);
}

}  // namespace plumb::impulse
