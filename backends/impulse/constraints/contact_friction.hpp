// Friction impulses of a contact, both tangents of a point at once.
//
// What would stop the slip is taken as it is where it lies within the circle of radius mu times the current normal
// impulse of the same point. Where it does not, the point slides, and the impulse takes a projected step against the
// slip: only then is it opposite to the slip when it no longer changes (maximum dissipation). The impulse that stops
// the slip, cut to the circle, is not: it leans by the ratio of the effective masses, and a cube on a slope slides by
// itself at 94 % of its friction.
#pragma once

#include <type_traits>

#include "constraints/contact.hpp"

namespace plumb::impulse {

/// All points rub in all lanes.
struct Always {
  PLUMB_HD bool operator()(int) const { return true; }
};

/// rubs(p): the lanes in which point p takes part.
template <int P, class N, class Rubs>
PLUMB_HD void solve_friction_where(Contact<N>& contact, SolverBody<N>& a, SolverBody<N>& b, const Rubs& rubs) {
  const Vec3<N> t1 = contact.tangent;
  const Vec3<N> t2 = cross(contact.normal, t1);
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    ContactPoint<N>& point = contact.points[p];
    const Vec3<N> ra = contact.arm_a(p), rb = contact.arm_b(p);
    const Vec3<N> slip = velocity_at(b, rb) - velocity_at(a, ra);
    const N v1 = dot(slip, t1), v2 = dot(slip, t2);
    const N m11 = point.tangent_mass[0], m12 = point.tangent_mass[1], m22 = point.tangent_mass[2];
    const N old1 = point.impulse[1], old2 = point.impulse[2];
    const N most = contact.friction * point.impulse[0];
    const N stop1 = old1 - (m11 * v1 + m12 * v2), stop2 = old2 - (m12 * v1 + m22 * v2);
    const auto slides = stop1 * stop1 + stop2 * stop2 > most * most;
    N new1 = stop1, new2 = stop2;
    if (any(slides)) {
      const N slide1 = old1 - point.tangent_step * v1, slide2 = old2 - point.tangent_step * v2;
      const N size = sqrt(slide1 * slide1 + slide2 * slide2);
      const N cut = select(size > most, most / max(size, N(Real(1e-30))), N(1));
      new1 = select(slides, cut * slide1, stop1);
      new2 = select(slides, cut * slide2, stop2);
    }
    if constexpr (!std::is_same_v<Rubs, Always>) {
      new1 = select(rubs(p), new1, old1);
      new2 = select(rubs(p), new2, old2);
    }
    point.impulse[1] = new1;
    point.impulse[2] = new2;
    const Vec3<N> impulse = (new1 - old1) * t1 + (new2 - old2) * t2;
    push(a, ra, -impulse);
    push(b, rb, impulse);
  }
}
template <int P, class N>
PLUMB_HD void solve_friction(Contact<N>& contact, SolverBody<N>& a, SolverBody<N>& b) {
  solve_friction_where<P>(contact, a, b, Always{});
}

}  // namespace plumb::impulse
