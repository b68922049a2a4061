// Pair functions of a convex shape with one triangle of a mesh or a height field, in the surface's frame; the surface
// is the first shape.
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

}  // namespace plumb::impulse
