// Spheres and what they touch: always one point, so the feature is always 0.
#pragma once

#include "geometry/shape.hpp"
#include "narrowphase/manifold.hpp"

namespace plumb::impulse {

/// One point where a ball of radius `radius_a` about the origin of A meets what lies `distance` from its centre.
PLUMB_HD inline bool touch_ball(Real radius_a, const Vec& normal, Real distance, Real margin, Manifold& out) {
  const Real separation = distance - radius_a;
  out.count = separation <= margin ? 1U : 0U;
  out.normal = normal;
  out.points[0] = {(radius_a + Real(0.5) * separation) * normal, separation, 0};
  return out.count != 0;
}

PLUMB_HD inline bool collide_sphere_sphere(const ShapePair& pair, const Hulls&, Manifold& out) {
  return touch_ball(pair.a.size.x, normalized_or(pair.d, {0, 1, 0}), length(pair.d) - pair.b.size.x, pair.margin, out);
}

PLUMB_HD inline bool collide_sphere_box(const ShapePair& pair, const Hulls&, Manifold& out) {
  const Vec centre = rotate_back(pair.qb, -pair.d);  // in the box's frame
  const Vec nearest = max(min(centre, pair.b.size), -pair.b.size);
  const Vec away = centre - nearest;
  const Real distance = length(away);
  if (distance > 0)
    return touch_ball(pair.a.size.x, rotate(pair.qb, (-1 / distance) * away), distance, pair.margin, out);
  // The centre is inside: out through the nearest face.
  const Vec depth = pair.b.size - abs(centre);
  const int axis = depth.x <= depth.y ? (depth.x <= depth.z ? 0 : 2) : (depth.y <= depth.z ? 1 : 2);
  Vec normal = {0, 0, 0};
  normal[axis] = centre[axis] < 0 ? Real(1) : Real(-1);
  return touch_ball(pair.a.size.x, rotate(pair.qb, normal), -depth[axis], pair.margin, out);
}

}  // namespace plumb::impulse
