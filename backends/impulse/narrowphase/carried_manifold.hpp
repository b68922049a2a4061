// A manifold of an earlier step as its bodies lie now.
#pragma once

#include "narrowphase/convex/polyhedron.hpp"
#include "narrowphase/narrow_phase_work.hpp"

namespace plumb::impulse {

/// How far a point may have slid, as a share of the thinner shape's inner radius: where edges cross, or an edge ends,
/// the true point has gone along one body and not along the other.
constexpr Real kMostSlide = Real(2e-3);

/// What counts of a shape's size, m.
struct ShapeSize {
  Real reach;         ///< from its origin to what is furthest
  Real inner_radius;  ///< of a ball about its middle that it holds

  PLUMB_HD ShapeSize(const Shape& shape, const Hulls& hulls) : reach(shape.reach), inner_radius(kHuge) {
    if (shape.type == ShapeType::kBox) inner_radius = BoxView{shape.size}.inner_radius();
    if (shape.type == ShapeType::kCylinder) inner_radius = min(shape.size.x, shape.size.y);
    if (shape.type == ShapeType::kHull) inner_radius = hulls.ranges[shape.hull].inner_radius;
    if (shape.type == ShapeType::kPlane) reach = kHuge;
  }
};

/// The turn from then to now.
PLUMB_HD inline Quat turn_since(const Quat& then, const Quat& now) { return now * conjugate(then); }
/// Between two turns, rad, where it is small; a quaternion and its negative are the same turn, and count as far apart.
PLUMB_HD inline Real angle_between(const Quat& a, const Quat& b) {
  const Vec u = vector_part(b) - vector_part(a);
  const Real w = b.w - a.w;
  return 2 * sqrt(length_squared(u) + w * w);
}

/// The manifold as the bodies lie now; false where a point of it has slid too far, or more may be in reach by now.
PLUMB_HD inline bool carry(const NarrowPhaseWork& work, const CollidedManifold& before, Pair pair, Manifold& out) {
  const Bodies& bodies = work.bodies;
  const Proxy &a = work.proxies.rows[pair.a], &b = work.proxies.rows[pair.b];
  const ShapeSize size_a(work.proxies.shapes[a.shape], work.proxies.hulls);
  const ShapeSize size_b(work.proxies.shapes[b.shape], work.proxies.hulls);
  const Real reach = min(size_a.reach, size_b.reach);
  const Real most = kMostSlide * min(size_a.inner_radius, size_b.inner_radius);
  const Quat turn_a = turn_since(before.orientation_a, bodies.orientation[a.body]);
  const Quat turn_b = turn_since(before.orientation_b, bodies.orientation[b.body]);
  if (!(angle_between(turn_a, turn_b) * reach <= most) || !(work.margin(pair) <= before.margin + most)) return false;

  const Vec moved = between(before.apart, bodies.position[b.body] - bodies.position[a.body]);
  const Vec apart_then = between({0, 0, 0}, before.apart);
  const Vec origin_then = rotate(before.orientation_a, a.frame.position);
  const Vec origin = rotate(bodies.orientation[a.body], a.frame.position);
  const Manifold& then = before.manifold;
  out.normal = then.normal + change_by_turn(turn_b, then.normal);
  out.count = then.count;
  PLUMB_UNROLL
  for (std::uint32_t i = 0; i < kManifoldPoints; ++i) {
    if (i >= then.count) break;
    const ManifoldPoint& point = then.points[i];
    const Vec arm_a = origin_then + point.position, arm_b = arm_a - apart_then;
    const Vec by_a = change_by_turn(turn_a, arm_a);
    const Vec slide = moved + change_by_turn(turn_b, arm_b) - by_a;
    if (!(length_squared(slide) <= most * most)) return false;
    out.points[i] = {arm_a + by_a + Real(0.5) * slide - origin, point.separation + dot(slide, out.normal),
                     point.feature};
  }
  return true;
}

}  // namespace plumb::impulse
