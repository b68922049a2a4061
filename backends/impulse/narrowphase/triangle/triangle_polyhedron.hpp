// Boxes and hulls against a triangle of a surface, in the surface's frame; the surface is the first shape.
//
// Separating axes as for two polyhedra (polyhedra.hpp): the triangle's plane, the faces of the polyhedron, and those
// pairs of edges for which the polyhedron's edge is foremost. The plane of the triangle is the contact's, unless
// another axis is better and the surface bulges that way.
#pragma once

#include "math/mat33.hpp"
#include "narrowphase/convex/face_overlap.hpp"
#include "narrowphase/convex/polyhedra.hpp"
#include "narrowphase/triangle/triangle_side.hpp"

namespace plumb::impulse {

namespace surface {

/// A side of a triangle as a polyhedron's only face.
struct TriangleView {
  const TriangleSide& side;

  PLUMB_HD std::uint32_t vertex_count() const { return 3; }
  PLUMB_HD std::uint32_t edge_count() const { return 3; }
  PLUMB_HD HullEdge edge(std::uint32_t e) const { return {e, e == 2 ? 0 : e + 1, 0, 0}; }
  PLUMB_HD std::uint32_t support(const Vec& n) const {
    const Real s[3] = {dot(n, vertex(0)), dot(n, vertex(1)), dot(n, vertex(2))};
    return s[0] >= s[1] ? (s[0] >= s[2] ? 0U : 2U) : (s[1] >= s[2] ? 1U : 2U);
  }
  PLUMB_HD Vec vertex(std::uint32_t v) const { return side.triangle.at[v]; }
  PLUMB_HD Vec normal(std::uint32_t) const { return side.normal; }
  PLUMB_HD Real offset(std::uint32_t) const { return side.offset; }
  PLUMB_HD std::uint32_t loop_size(std::uint32_t) const { return 3; }
  PLUMB_HD std::uint32_t loop(std::uint32_t, std::uint32_t k) const { return side.reversed ? 2 - k : k; }
};

/// The axis across which the triangle and the polyhedron are furthest apart, other than across the triangle's plane.
struct SideAxis {
  Vec normal;  ///< unit, from the triangle to the polyhedron
  Real separation = -kHuge;
  bool of_edges = false;
  int k = 0;  ///< the triangle's edge
  std::uint32_t edge = 0;
};

/// False when an axis separates by more than margin.
template <class View>
PLUMB_HD bool find_side_axis(const Triangle& t, const View& view, const polyhedra::Placement& at, Real margin, Real tie,
                             SideAxis& best) {
  const auto furthest = [&](const Vec& n) { return max(dot(n, t.at[0]), max(dot(n, t.at[1]), dot(n, t.at[2]))); };
  for (std::uint32_t f = 0; f < view.face_count(); ++f) {
    const Vec n = -(at.turn * view.normal(f));
    const Real s = -(view.offset(f) - dot(n, at.shift)) - furthest(n);
    if (s > margin) return false;
    if (s > best.separation + tie) best = {n, s, false, 0, 0};
  }
  for (std::uint32_t e = 0; e < view.edge_count(); ++e) {
    const HullEdge edge = view.edge(e);
    const Vec left = at.turn * view.normal(edge.left), right = at.turn * view.normal(edge.right);
    for (int k = 0; k < 3; ++k) {
      const Vec side = t.at[k == 2 ? 0 : k + 1] - t.at[k];
      if (!(dot(left, side) * dot(right, side) < 0)) continue;  // no direction across both is between the faces
      const Vec from = at.turn * view.vertex(edge.from) + at.shift;
      const Vec along = at.turn * (view.vertex(edge.to) - view.vertex(edge.from));
      Vec n = cross(side, along);
      const Real square = length_squared(n);
      if (square <= kParallel * kParallel * length_squared(side) * length_squared(along)) continue;
      n = ((dot(n, left + right) > 0 ? Real(-1) : Real(1)) / sqrt(square)) * n;
      const Real s = dot(n, from) - furthest(n);
      if (s > margin) return false;
      if (s > best.separation + tie) best = {n, s, true, k, e};
    }
  }
  return true;
}

/// Which part of the triangle is foremost along a direction: one corner, or an edge where two are level.
struct Foremost {
  int corner, edge;  ///< edge: -1 where it is a corner alone
  bool all;          ///< all three corners are level
};
PLUMB_HD inline Foremost foremost(const Triangle& t, const Vec& n) {
  const Real s[3] = {dot(n, t.at[0]), dot(n, t.at[1]), dot(n, t.at[2])};
  const int best = s[0] >= s[1] ? (s[0] >= s[2] ? 0 : 2) : (s[1] >= s[2] ? 1 : 2);
  const int next = best == 2 ? 0 : best + 1, before = best == 0 ? 2 : best - 1;
  const bool next_level = s[best] - s[next] <= kAlongPlane * length(t.at[next] - t.at[best]);
  const bool before_level = s[best] - s[before] <= kAlongPlane * length(t.at[before] - t.at[best]);
  return {best, next_level ? best : before_level ? before : -1, next_level && before_level};
}

template <class Surface>
PLUMB_HD Bulge bulge_at(const Surface& on, std::uint32_t t, const Triangle& triangle, const Foremost& front,
                        const Vec& direction) {
  return bulge_of(front.edge >= 0 ? rise_at_edge(on, t, triangle, front.edge, direction)
                                  : rise_at_corner(on, triangle.corner[front.corner], direction));
}

/// What a better axis than that of the triangle's plane means.
enum class Touches {
  kFace,    ///< the surface does not bulge that way: its plane holds all the same
  kEdge,    ///< the contact is across that axis
  kEither,  ///< both: across the plane if the face lies over the triangle, else across the axis
  kNeighbour
};
/// direction: the better axis, from the triangle to what touches, of which centre and extent across the plane are
/// given; by_plane: the separation there. The plane holds what comes from before it, what lies over the triangle, and
/// what is not deep below it; but not a box that stands at a rim, and is behind the whole wall below.
template <class Surface>
PLUMB_HD Touches what_touches(const Surface& on, std::uint32_t t, const TriangleSide& side, const Vec& direction,
                              Real by_plane, Real extent, const Vec& centre) {
  const Real along = dot(direction, side.normal);
  const Foremost front = foremost(side.triangle, direction);
  const Bulge bulge = front.all ? Bulge::kOut : bulge_at(on, t, side.triangle, front, direction);
  if (bulge == Bulge::kStrict) return along > kNearFace ? Touches::kEither : Touches::kEdge;
  if (along > kNearFace) return Touches::kFace;
  if (bulge == Bulge::kShared) return Touches::kNeighbour;
  const bool holds = along > Real(0.7) || -by_plane <= Real(0.25) * extent || side.is_over(centre, 0);
  return holds ? Touches::kFace : Touches::kNeighbour;
}

/// The edge or corner that is foremost, over the polyhedron's face.
template <class View>
PLUMB_HD void touch_with_edge(const Triangle& t, const View& view, const polyhedra::Placement& at, const SideAxis& axis,
                              const Foremost& front, Real margin, Manifold& out) {
  const Vec against = -multiply_transposed(at.turn, axis.normal);
  const std::uint32_t face = face_at_support(view, against);
  const int from_corner = front.edge >= 0 ? front.edge : front.corner;
  const Vec p = t.at[from_corner];
  const Vec d = front.edge >= 0 ? t.at[front.edge == 2 ? 0 : front.edge + 1] - p : Vec{0, 0, 0};
  if (axis.of_edges && dot(view.normal(face), against) < kNearFace) {
    const HullEdge edge = view.edge(axis.edge);
    const Vec q = at.turn * view.vertex(edge.from) + at.shift;
    const Vec side = t.at[axis.k == 2 ? 0 : axis.k + 1] - t.at[axis.k];
    const Vec along = at.turn * (view.vertex(edge.to) - view.vertex(edge.from));
    const ClosestPair closest = closest_between(t.at[axis.k], side, q, along);
    const Vec across = closest.on_b - closest.on_a - axis.separation * axis.normal;
    if (axis.separation > 0 &&
        length_squared(across) > kClipSlack * kClipSlack * max(length_squared(side), length_squared(along)))
      return;
    out.count = 1;
    out.points[0] = {
        Real(0.5) * (closest.on_a + closest.on_b), axis.separation,
        feature_id(Part::kEdge, static_cast<std::uint32_t>(axis.k), Part::kEdge, edge_between(edge.from, edge.to))};
    return;
  }
  const ContactPlane plane(axis.normal);
  const FacePolygon<View> polygon = {view, face, plane, at.turn, at.shift, true, view.loop_size(face)};
  const Vec from = plane.flatten(p), along = plane.flatten(d);
  const ClippedSide c = clip(polygon, polygon.slack(), from, along);
  if (c.empty) return;
  const FaceHeight height = polygon.height();
  const auto add = [&](Real s, std::uint32_t cut, std::uint32_t end) {
    const Vec at_point = from + s * along;
    const Real separation = max(height.at(at_point.x, at_point.y) - at_point.z, axis.separation);
    if (separation > margin) return;
    const std::uint32_t of_triangle = front.edge >= 0 ? static_cast<std::uint32_t>(front.edge) : 3U;
    out.points[out.count++] = {
        plane.unflatten({at_point.x, at_point.y, at_point.z + Real(0.5) * separation}), separation,
        feature_id(
            Part::kEdge, of_triangle, cut == ClippedSide::kUncut ? Part::kFace : Part::kEdge,
            cut == ClippedSide::kUncut ? 2 * face + end : edge_between(polygon.index(cut), polygon.index(cut + 1)))};
  };
  add(c.s0, c.cut0, 0);
  if (length_squared(along) * (c.s1 - c.s0) * (c.s1 - c.s0) > 0) add(c.s1, c.cut1, 1);
}

/// Puts corners of the polyhedron before what lies on the triangle's edges, and returns how many there are. A corner
/// goes on to the next triangle as the same point, so that of all triangles together the corners are left, as of a
/// plane (manifold_reduction.hpp).
PLUMB_HD inline int put_corners_first(Overlap& overlap) {
  int corners = 0;
  for (int i = 0; i < overlap.count; ++i) {
    const Candidate point = overlap.at[i];
    if ((point.feature & 0xffffU) >> 14U != static_cast<std::uint32_t>(Part::kVertex)) continue;
    overlap.at[i] = overlap.at[corners];
    overlap.at[corners++] = point;
  }
  return corners;
}

/// The polyhedron's face over the triangle.
template <class View>
PLUMB_HD void touch_with_face(const TriangleSide& side, const View& view, const polyhedra::Placement& at, Real deepest,
                              Real margin, Real tie, Manifold& out) {
  const Vec against = -multiply_transposed(at.turn, side.normal);
  const std::uint32_t face = face_at_support(view, against);
  const ContactPlane plane(side.normal);
  const TriangleView triangle{side};
  const FacePolygon<TriangleView> polygon_a = {triangle, 0, plane, polyhedra::kNoTurn, {0, 0, 0}, false, 3};
  const FacePolygon<View> polygon_b = {view, face, plane, at.turn, at.shift, true, view.loop_size(face)};
  Overlap overlap;
  overlap.deepest = deepest;
  overlap.margin = margin;
  overlap.tie = tie;
  overlap_faces(polygon_a, polygon_b, overlap);
  const int corners = put_corners_first(overlap);
  const int set = corners <= kManifoldPoints ? max(corners, 1) : 1;
  const int count = choose_points(overlap.at, overlap.count, tie, set);
  out.count = static_cast<std::uint32_t>(count);
  for (int i = 0; i < count; ++i) {
    const Candidate& c = overlap.at[i];
    out.points[i] = {plane.unflatten({c.x, c.y, side.offset + Real(0.5) * c.separation}), c.separation, c.feature};
  }
}

template <class Surface, class View>
PLUMB_HD bool touch_polyhedron(const Surface& on, std::uint32_t t, const View& view, const polyhedra::Placement& at,
                               Real margin, Real tie, Manifold& out) {
  out.count = 0;
  TriangleSide side(on.triangle(t));
  const Vec n_b = multiply_transposed(at.turn, side.normal);
  const Real shift = dot(side.normal, at.shift) - side.offset;
  const Real low = shift + dot(n_b, view.vertex(view.support(-n_b))),
             high = shift + dot(n_b, view.vertex(view.support(n_b)));
  if (low > margin || high < -margin) return false;
  if (!choose_side(on, at.turn * view.centre() + at.shift, low, high, side)) return false;
  const Real separation = side.reversed ? -high : low;
  SideAxis axis;
  if (separation > margin || !find_side_axis(side.triangle, view, at, margin, tie, axis)) return false;

  Touches touches = Touches::kFace;
  if (axis.separation > separation + tie)
    touches = what_touches(on, t, side, axis.normal, separation, high - low, at.turn * view.centre() + at.shift);
  if (touches == Touches::kNeighbour) return false;
  if (touches != Touches::kEdge) {
    out.normal = side.normal;
    touch_with_face(side, view, at, separation, margin, tie, out);
  }
  if (out.count == 0 && touches != Touches::kFace) {
    out.normal = axis.normal;
    touch_with_edge(side.triangle, view, at, axis, foremost(side.triangle, axis.normal), margin, out);
  }
  return out.count != 0;
}

}  // namespace surface

}  // namespace plumb::impulse
