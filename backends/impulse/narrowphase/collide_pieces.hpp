// Pair functions of a convex shape A with a plane, or with one triangle of a mesh or a height field, B. Parameters as
// in collide.hpp, the shape's row among the surfaces, and the triangle.
#pragma once

#include "body.hpp"
#include "narrowphase/plane.hpp"
#include "narrowphase/round_polyhedron.hpp"
#include "narrowphase/triangle_cylinder.hpp"
#include "narrowphase/triangle_polyhedron.hpp"
#include "narrowphase/triangle_round.hpp"

namespace plumb::impulse {

namespace surface {

template <class Surface>
PLUMB_HD bool touch(const Surface& on, std::uint32_t t, const Shape& shape, const Quat& turn, const Vec& shift,
                    Real margin, Real tie, const Hulls& hulls, Manifold& out) {
  switch (shape.type) {
    case ShapeType::kSphere: return touch_round(on, t, shift, {0, 0, 0}, shape.size.x, margin, out);
    case ShapeType::kCapsule: {
      const Vec half = rotate(turn, Vec{0, shape.size.y, 0});
      return touch_round(on, t, shift - half, half + half, shape.size.x, margin, out);
    }
    case ShapeType::kBox:
      return touch_polyhedron(on, t, BoxView{shape.size}, {to_matrix(turn), shift}, margin, tie, out);
    case ShapeType::kHull:
      return touch_polyhedron(on, t, HullView(hulls, shape.hull), {to_matrix(turn), shift}, margin, tie, out);
    case ShapeType::kCylinder:
      return touch_cylinder(on, t, {shape.size.x, shape.size.y}, {to_matrix(turn), shift}, margin, tie, out);
    default: out.count = 0; return false;
  }
}

}  // namespace surface

PLUMB_HD inline bool collide_with_piece(const Shape& a, const Quat& qa, const Shape& b, const Quat& qb, const Vec& d,
                                        Real margin, const Proxies& proxies, std::uint32_t triangle, Manifold& out) {
  const Quat turn = conjugate(qb) * qa;
  const Vec shift = rotate_back(qb, -d);
  const Real tie = kTie * (a.reach + length(shift));
  bool touch = false;
  if (b.type == ShapeType::kPlane)
    touch = touch_plane(a, turn, shift, margin, proxies.hulls, out);
  else if (b.type == ShapeType::kMesh)
    touch = surface::touch(proxies.surfaces.meshes[b.hull], triangle, a, turn, shift, margin, tie, proxies.hulls, out);
  else
    touch = surface::touch(proxies.surfaces.fields[b.hull], triangle, a, turn, shift, margin, tie, proxies.hulls, out);
  if (touch) round_polyhedron::put_second(qb, d, out);
  return touch;
}

}  // namespace plumb::impulse
