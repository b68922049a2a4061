// Cylinders against a triangle of a surface, in the surface's frame; the surface is the first shape. The choice of the
// axis is that of polyhedra (triangle_polyhedron.hpp).
#pragma once

#include "narrowphase/convex/cylinder_axes.hpp"
#include "narrowphase/triangle/triangle_polyhedron.hpp"

namespace plumb::impulse {

namespace surface {

template <class Surface>
PLUMB_HD bool touch_cylinder(const Surface& on, std::uint32_t t, const cylinder::Cylinder& c,
                             const polyhedra::Placement& of_cylinder, Real margin, Real tie, Manifold& out) {
  out.count = 0;
  TriangleSide side(on.triangle(t));
  const auto to_cylinder = [&](const Vec& v) { return multiply_transposed(of_cylinder.turn, v); };
  const Real middle = side.height(of_cylinder.shift), reach = c.reach(to_cylinder(side.normal));
  if (middle - reach > margin || middle + reach < -margin) return false;
  if (!choose_side(on, of_cylinder.shift, middle - reach, middle + reach, side)) return false;
  const Real separation = (side.reversed ? -middle : middle) - reach;
  if (separation > margin) return false;

  // The triangle as the cylinder sees it.
  const Mat& m = of_cylinder.turn;
  const polyhedra::Placement at = {{{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}},
                                   -to_cylinder(of_cylinder.shift)};
  const TriangleView view{side};
  const auto arc = [&](std::uint32_t e, const Vec& v, Vec& from, Vec& to) {
    from = -to_cylinder(side.normal);
    to = -to_cylinder(normalized_or(side.outward(static_cast<int>(e)), side.normal));
    return !cylinder::narrows_from(c, v, from, to);
  };
  cylinder::Axis axis;
  if (!cylinder::try_corners(c, view, at, margin, tie, axis) ||
      !cylinder::try_edges(c, view, at, arc, margin, tie, axis))
    return false;

  const Vec direction = -(of_cylinder.turn * axis.normal);
  Touches touches = Touches::kFace;
  if (axis.separation > separation + tie)
    touches = what_touches(on, t, side, direction, separation, 2 * reach, of_cylinder.shift);
  if (touches == Touches::kNeighbour) return false;
  Vec normal = -to_cylinder(side.normal);
  if (touches != Touches::kEdge) {
    const FacePolygon<TriangleView> polygon = {view, 0, ContactPlane(normal), at.turn, at.shift, true, 3};
    cylinder::touch_face(c, normal, polygon, true, separation, margin, tie, out);
  }
  if (out.count == 0 && touches != Touches::kFace) {
    normal = axis.normal;
    const Foremost front = foremost(side.triangle, direction);
    const int from = front.edge >= 0 ? front.edge : front.corner;
    const Vec p = at.turn * side.triangle.at[from] + at.shift;
    const Vec d = front.edge >= 0 ? at.turn * side.triangle.at[from == 2 ? 0 : from + 1] + at.shift - p : Vec{0, 0, 0};
    cylinder::touch_edge(c, normal, p, d, 0, axis.separation, margin, out);
  }
  out.normal = -(of_cylinder.turn * normal);
  for (std::uint32_t i = 0; i < out.count; ++i) {
    out.points[i].position = of_cylinder.turn * out.points[i].position + of_cylinder.shift;
    out.points[i].feature = swapped_feature(out.points[i].feature);
  }
  return out.count != 0;
}

}  // namespace surface

}  // namespace plumb::impulse
