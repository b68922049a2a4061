// On which side of a sheet a body is that must not pass it.
//
// The narrow phase, which remembers nothing, lets the outside of a triangle push what is not clearly behind it. A
// flagged body may overlap a sheet from behind by more than that after an impact; it is on the side of its middle,
// which has never passed.
#pragma once

#include "continuous/impact.hpp"
#include "narrowphase/collide.hpp"
#include "narrowphase/collide_pieces.hpp"

namespace plumb::impulse {

/// A surface as it is, or turned inside out.
template <class Surface>
struct SidedSurface {
  const Surface& on;
  bool reversed;

  PLUMB_HD Vec corner(std::uint32_t v) const { return on.corner(v); }
  PLUMB_HD Triangle triangle(std::uint32_t t) const {
    const Triangle r = on.triangle(t);
    if (!reversed) return r;
    return {{r.at[0], r.at[2], r.at[1]}, {r.corner[0], r.corner[2], r.corner[1]}};
  }
  PLUMB_HD std::uint32_t across(std::uint32_t t, int k) const { return on.across(t, reversed ? 2 - k : k); }
  template <class F>
  PLUMB_HD void around(std::uint32_t v, F& f) const {
    on.around(v, f);
  }
  PLUMB_HD bool is_closed() const { return on.is_closed(); }
};

/// Whether the middle of a convex shape is behind the triangle of a sheet at the start. Of a plane or a closed mesh
/// nobody is behind. apart: from its body's centre of mass to that of the sheet's.
PLUMB_HD inline bool is_behind(const MovingShape& own, const MovingShape& on, const Vec& apart, const Proxies& proxies,
                               std::uint32_t t) {
  const Shape &sheet = *on.shape, &shape = *own.shape;
  if (!is_surface(sheet.type)) return false;
  if (sheet.type == ShapeType::kMesh && proxies.surfaces.meshes[sheet.hull].is_closed()) return false;
  const ShapePose pose = own.pose(0), pose_on = on.pose(0);
  const Vec inside = shape.type == ShapeType::kHull ? proxies.hulls.ranges[shape.hull].centre : Vec{0, 0, 0};
  const Vec middle =
      rotate_back(pose_on.orientation, pose.offset + rotate(pose.orientation, inside) - apart - pose_on.offset);
  const Triangle triangle = triangle_of(sheet, proxies.surfaces, t);
  const Vec normal = cross(triangle.at[1] - triangle.at[0], triangle.at[2] - triangle.at[0]);
  return dot(normal, middle - triangle.at[0]) < 0;
}

/// As collide_with_piece(), behind: from the other side of a sheet.
PLUMB_HD inline bool collide_with_side(const ShapePair& pair, const Proxies& proxies, std::uint32_t triangle,
                                       bool behind, Manifold& out) {
  const Quat turn = conjugate(pair.qb) * pair.qa;
  const Vec shift = rotate_back(pair.qb, -pair.d);
  const surface::ShapeOver over = {pair.a, turn, shift, pair.margin, kTie * (pair.a.reach + length(shift))};
  const auto touch_on = [&](const auto& on) {
    const SidedSurface<std::remove_cvref_t<decltype(on)>> sided{on, behind};
    return surface::touch(sided, triangle, over, proxies.hulls, out);
  };
  const bool touches = pair.b.type == ShapeType::kPlane
                           ? touch_plane(pair.a, turn, shift, pair.margin, proxies.hulls, out)
                       : pair.b.type == ShapeType::kMesh ? touch_on(proxies.surfaces.meshes[pair.b.hull])
                                                         : touch_on(proxies.surfaces.fields[pair.b.hull]);
  if (touches) round_polyhedron::put_second(pair.qb, pair.d, out);
  return touches;
}

}  // namespace plumb::impulse
