// On which side of a sheet a shape is.
//
// A triangle pushes what overlaps it to its outside, but for what is clearly behind it. A body that must not pass
// sheets may overlap one from behind by more than that, after an impact; it is on the side of its middle, which has
// never passed. So is whatever is collided at a time of impact.
#pragma once

#include "narrowphase/shape_pair.hpp"
#include "narrowphase/triangle/triangle_core.hpp"

namespace plumb::impulse {

/// A surface as it is, or turned inside out.
template <class Surface>
struct SidedSurface {
  const Surface& on;
  bool reversed;

  PLUMB_HD Vec corner(std::uint32_t v) const { return on.corner(v); }
  PLUMB_HD Triangle triangle(std::uint32_t t) const {
    Triangle r = on.triangle(t);
    if (reversed) [[unlikely]]
      r = {{r.at[0], r.at[2], r.at[1]}, {r.corner[0], r.corner[2], r.corner[1]}};
    return r;
  }
  PLUMB_HD std::uint32_t across(std::uint32_t t, int k) const { return on.across(t, reversed ? 2 - k : k); }
  template <class F>
  PLUMB_HD void around(std::uint32_t v, F& f) const {
    on.around(v, f);
  }
  PLUMB_HD bool is_closed() const { return on.is_closed(); }
};

/// Whether the middle of a convex shape is behind triangle t of the surface that the other of a pair is. Of a closed
/// mesh nothing is behind.
PLUMB_HD inline bool is_behind(const ShapePair& pair, const Hulls& hulls, const Surfaces& surfaces, std::uint32_t t) {
  const bool sheet_first = is_surface(pair.a.type);
  const Shape &sheet = sheet_first ? pair.a : pair.b, &shape = sheet_first ? pair.b : pair.a;
  if (sheet.type == ShapeType::kMesh && surfaces.meshes[sheet.hull].is_closed()) return false;
  const Vec inside = shape.type == ShapeType::kHull ? hulls.ranges[shape.hull].centre : Vec{0, 0, 0};
  const Vec from_sheet = rotate(sheet_first ? pair.qb : pair.qa, inside) + (sheet_first ? pair.d : -pair.d);
  const Vec middle = rotate_back(sheet_first ? pair.qa : pair.qb, from_sheet);
  const Triangle triangle = triangle_of(sheet, surfaces, t);
  const Vec normal = cross(triangle.at[1] - triangle.at[0], triangle.at[2] - triangle.at[0]);
  return dot(normal, middle - triangle.at[0]) < 0;
}

}  // namespace plumb::impulse
