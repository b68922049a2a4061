// Convex shapes against a plane, the half space y <= 0 of its frame: the deepest points that each has. In the plane's
// frame, the plane as first shape.
#pragma once

#include "math/mat33.hpp"
#include "narrowphase/convex/face_overlap.hpp"
#include "narrowphase/convex/polyhedron.hpp"

namespace plumb::impulse {

namespace plane {

/// Where a shape is, in the plane's frame.
struct Placement {
  Mat turn;
  Vec shift;
};

PLUMB_HD inline void add(const Vec& lowest, Real margin, std::uint32_t feature, Manifold& out) {
  if (lowest.y <= margin) out.points[out.count++] = {{lowest.x, Real(0.5) * lowest.y, lowest.z}, lowest.y, feature};
}

template <class View>
PLUMB_HD void touch_polyhedron(const View& view, const Placement& at, Real margin, Real tie, Manifold& out) {
  Overlap overlap;
  overlap.deepest = -kHuge;
  overlap.margin = margin;
  overlap.tie = tie;
  for (std::uint32_t v = 0; v < view.vertex_count(); ++v) {
    const Vec p = at.turn * view.vertex(v) + at.shift;
    overlap.add(p.x, p.z, p.y, feature_id(Part::kFace, 0, Part::kVertex, v));
  }
  const int count = choose_points(overlap.at, overlap.count, tie);
  for (int i = 0; i < count; ++i) {
    const Candidate& c = overlap.at[i];
    add({c.x, c.separation, c.y}, margin, c.feature, out);
  }
}

/// A cylinder stands on its rim, on four points of it, or lies on a line of its side: of each cap the deepest point of
/// the rim, and three more of the lower cap. Where the cap is level those are the same places of it all the time. One
/// that lies so deep that the plane holds its lower cap lies on both caps all the same.
PLUMB_HD inline void touch_cylinder(const Vec& size, const Placement& at, Real margin, Manifold& out) {
  const Vec down = {at.turn.x.y, at.turn.y.y, at.turn.z.y};  // the plane's normal in the cylinder's frame
  const Real cap = down.y > 0 ? -size.y : size.y;
  const Real tilt = sqrt(down.x * down.x + down.z * down.z);
  const bool level = tilt <= kLevel;
  const Real ux = level ? Real(1) : -down.x / tilt, uz = level ? Real(0) : -down.z / tilt;
  const auto rim = [&](Real x, Real y, Real z, std::uint32_t feature) {
    const Vec p = at.turn * Vec{size.x * x, y, size.x * z} + at.shift;
    add(p, margin, feature_id(Part::kFace, 0, Part::kVertex, feature), out);
  };
  rim(ux, cap, uz, 0);
  const Vec opposite = at.turn * Vec{-size.x * ux, cap, -size.x * uz} + at.shift;
  const bool lies = abs(down.y) < tilt;
  if (opposite.y <= margin) {
    rim(-uz, cap, ux, 1);
    if (!lies) rim(-ux, cap, -uz, 2);
    rim(uz, cap, -ux, 3);
  }
  if (opposite.y > margin || lies) rim(ux, -cap, uz, 4);
}

}  // namespace plane

/// A convex shape of type kType as second, the plane as first, in the plane's frame.
template <ShapeType kType>
PLUMB_HD bool touch_plane_with(const Shape& shape, const Quat& turn, const Vec& shift, Real margin,
                               [[maybe_unused]] const Hulls& hulls, Manifold& out) {
  out.count = 0;
  out.normal = {0, 1, 0};
  if (shift.y - shape.reach > margin) return false;
  [[maybe_unused]] const plane::Placement at = {to_matrix(turn), shift};
  if constexpr (kType == ShapeType::kSphere) {
    plane::add({shift.x, shift.y - shape.size.x, shift.z}, margin, 0, out);
  } else if constexpr (kType == ShapeType::kBox) {
    plane::touch_polyhedron(BoxView{shape.size}, at, margin, kTie * shape.reach, out);
  } else if constexpr (kType == ShapeType::kCapsule) {
    const Vec half = shape.size.y * at.turn.y, down = {0, -shape.size.x, 0};
    plane::add(shift - half + down, margin, 0, out);
    if (shape.size.y > 0) plane::add(shift + half + down, margin, 1, out);
  } else if constexpr (kType == ShapeType::kHull) {
    plane::touch_polyhedron(HullView(hulls, shape.hull), at, margin, kTie * shape.reach, out);
  } else {
    static_assert(kType == ShapeType::kCylinder);
    plane::touch_cylinder(shape.size, at, margin, out);
  }
  return out.count != 0;
}

PLUMB_HD inline bool touch_plane(const Shape& shape, const Quat& turn, const Vec& shift, Real margin,
                                 const Hulls& hulls, Manifold& out) {
  out.count = 0;
  return with_convex_type(shape.type,
                          [&](auto type) { return touch_plane_with<type()>(shape, turn, shift, margin, hulls, out); });
}

}  // namespace plumb::impulse
