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

PLUMB_HD inline bool collide_sphere_sphere(const Shape& a, const Quat&, const Shape& b, const Quat&, const Vec& d,
                                           Real margin, const Hulls&, Manifold& out) {
  return touch_ball(a.size.x, normalized_or(d, {0, 1, 0}), length(d) - b.size.x, margin, out);
}

PLUMB_HD inline bool collide_sphere_box(const Shape& a, const Quat&, const Shape& b, const Quat& qb, const Vec& d,
                                        Real margin, const Hulls&, Manifold& out) {
  const Vec centre = rotate_back(qb, -d);  // in the box's frame
  const Vec nearest = max(min(centre, b.size), -b.size);
  const Vec away = centre - nearest;
  const Real distance = length(away);
  if (distance > 0) return touch_ball(a.size.x, rotate(qb, (-1 / distance) * away), distance, margin, out);
  // The centre is inside: out through the nearest face.
  const Vec depth = b.size - abs(centre);
  const int axis = depth.x <= depth.y ? (depth.x <= depth.z ? 0 : 2) : (depth.y <= depth.z ? 1 : 2);
  Vec normal = {0, 0, 0};
  normal[axis] = centre[axis] < 0 ? Real(1) : Real(-1);
  return touch_ball(a.size.x, rotate(qb, normal), -depth[axis], margin, out);
}

}  // namespace plumb::impulse
