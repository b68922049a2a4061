// Spheres and capsules against boxes and hulls: the closest points of a point or a segment and the polyhedron, and
// where it is inside, the shortest way out.
#pragma once

#include "narrowphase/convex/capsule.hpp"
#include "narrowphase/convex/face_overlap.hpp"
#include "narrowphase/convex/segments.hpp"

namespace plumb::impulse {

namespace round_polyhedron {

/// Where a point or segment comes closest to a polyhedron.
struct Closest {
  Vec on_polyhedron;
  Vec normal;     ///< unit, outward
  Real distance;  ///< negative inside
};

/// Whether p, seen along the face's normal, lies within it.
template <class View>
PLUMB_HD bool over_face(const View& view, std::uint32_t face, const Vec& p) {
  const std::uint32_t size = view.loop_size(face);
  const Vec n = view.normal(face);
  Vec from = view.vertex(view.loop(face, size - 1));
  for (std::uint32_t k = 0; k < size; ++k) {
    const Vec to = view.vertex(view.loop(face, k));
    if (dot(cross(to - from, p - from), n) < 0) return false;
    from = to;
  }
  return true;
}

/// The face above which the lower end of the segment p + [0, 1] d is highest.
template <class View>
PLUMB_HD std::uint32_t highest_face(const View& view, const Vec& p, const Vec& d, Real tie, Real& height) {
  std::uint32_t best = 0;
  height = -kHuge;
  for (std::uint32_t f = 0; f < view.face_count(); ++f) {
    const Vec n = view.normal(f);
    const Real h = dot(n, p) + min(dot(n, d), Real(0)) - view.offset(f);
    if (h > height + tie) {
      height = h;
      best = f;
    }
  }
  return best;
}

/// From outside to the closest edge, which has a face that is seen from some point of the segment.
template <class View>
PLUMB_HD void closest_edge(const View& view, const Vec& p, const Vec& d, Real tie, Closest& closest) {
  const auto seen = [&](std::uint32_t face) {
    const Vec n = view.normal(face);
    return dot(n, p) + max(dot(n, d), Real(0)) >= view.offset(face) - tie;
  };
  for (std::uint32_t e = 0; e < view.edge_count(); ++e) {
    const HullEdge edge = view.edge(e);
    if (!seen(edge.left) && !seen(edge.right)) continue;
    const Vec from = view.vertex(edge.from);
    const ClosestPair pair = closest_between(from, view.vertex(edge.to) - from, p, d);
    const Vec away = pair.on_b - pair.on_a;
    const Real distance = length(away);
    if (distance < closest.distance) closest = {pair.on_a, normalized_or(away, view.normal(edge.left)), distance};
  }
}

/// The shortest way out for a segment that enters the polyhedron no deeper than `height` below every face: across an
/// edge, if that is shorter. True if one of the axes even separates them.
template <class View>
PLUMB_HD bool out_across_edge(const View& view, const Vec& p, const Vec& d, Real tie, Closest& closest) {
  const Real dd = length_squared(d);
  for (std::uint32_t e = 0; e < view.edge_count(); ++e) {
    const HullEdge edge = view.edge(e);
    const Vec left = view.normal(edge.left), right = view.normal(edge.right);
    if (!(dot(left, d) * dot(right, d) < 0)) continue;  // the segment's great circle passes the edge's arc by
    const Vec from = view.vertex(edge.from), along = view.vertex(edge.to) - from;
    Vec n = cross(along, d);
    const Real square = length_squared(n);
    if (square <= kParallel * kParallel * dd * length_squared(along)) continue;
    n = ((dot(n, left + right) < 0 ? Real(-1) : Real(1)) / sqrt(square)) * n;
    if (dot(n, p - from) <= closest.distance + tie) continue;
    const Real s = dot(n, p) + min(dot(n, d), Real(0)) - dot(n, view.vertex(view.support(n)));
    if (s > closest.distance + tie) closest = {closest_between(from, along, p, d).on_a, n, s};
    if (s > 0) return true;
  }
  return false;
}

/// False when the distance is found to exceed `most`, else the closest points.
template <class View>
PLUMB_HD bool find_closest(const View& view, const Vec& p, const Vec& d, Real most, Real tie, Closest& out) {
  Real height;
  const std::uint32_t face = highest_face(view, p, d, tie, height);
  if (height > most) return false;
  const Vec n = view.normal(face);
  const Vec lower = dot(n, d) < 0 ? p + d : p;
  const bool over = over_face(view, face, lower);
  if (height > 0 && over) {  // no point of the polyhedron is closer than its face's plane
    out = {lower - height * n, n, height};
    return true;
  }
  if (height <= 0) {
    out = {lower - height * n, n, height};
    const bool point = length_squared(d) == 0;
    if (point || !out_across_edge(view, p, d, tie, out)) return true;
  }
  out.distance = kHuge;
  closest_edge(view, p, d, tie, out);
  // Where rounding leaves no direction the face's is as good.
  if (out.distance <= tie) out = {out.on_polyhedron, n, max(height, Real(0))};
  return out.distance <= most;
}

/// The two ends of a capsule's line of contact with the face that its axis looks at, in the polyhedron's frame. The
/// normal of `out` is set; returns with no points where the segment does not lie over the face.
template <class View>
PLUMB_HD void lay_on_face(const View& view, const Vec& p, const Vec& d, Real radius, const Closest& closest,
                          Real margin, Manifold& out) {
  const std::uint32_t face = face_at_support(view, closest.normal);
  if (dot(view.normal(face), closest.normal) < kNearFace) return;
  const ContactPlane plane(closest.normal);
  const FacePolygon<View> polygon = {
      view, face, plane, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, false, view.loop_size(face)};
  const Vec from = plane.flatten(p), along = plane.flatten(d);
  const ClippedSide c = clip(polygon, polygon.slack(), from, along);
  if (c.empty) return;
  const FaceHeight height = polygon.height();
  Real least = kHuge;
  std::uint32_t deepest = 0;
  const auto add = [&](Real s, std::uint32_t cut, std::uint32_t end) {
    const Vec at = from + s * along;
    const Real floor = height.at(at.x, at.y), above = max(at.z - floor, closest.distance);
    const Real separation = above - radius;
    if (above < least) {
      least = above;
      deepest = out.count;
    }
    if (separation > margin) return;
    const std::uint32_t feature =
        cut == ClippedSide::kUncut
            ? feature_id(Part::kFace, face, Part::kVertex, end)
            : feature_id(Part::kEdge, edge_between(polygon.index(cut), polygon.index(cut + 1)), Part::kEdge, 0);
    out.points[out.count++] = {plane.unflatten({at.x, at.y, floor}), separation, feature};
  };
  add(c.s0, c.cut0, 0);
  if (length_squared(along) * (c.s1 - c.s0) * (c.s1 - c.s0) > 0) add(c.s1, c.cut1, 1);
  if (out.count > 0 && deepest < out.count) out.points[deepest].separation = closest.distance - radius;
}

/// A ball or capsule of the given radius about p + [0, 1] d, in the polyhedron's frame and as seen from it: positions
/// on its surface still, normal towards the segment.
template <class View>
PLUMB_HD bool touch(const View& view, const Vec& p, const Vec& d, Real radius, Real margin, Real tie, Manifold& out) {
  out.count = 0;
  Closest closest;
  if (!find_closest(view, p, d, radius + margin, tie, closest)) return false;
  out.normal = closest.normal;
  if (length_squared(d) > 0) lay_on_face(view, p, d, radius, closest, margin, out);
  if (out.count == 0) {
    const std::uint32_t feature = feature_id(Part::kFace, 0, Part::kFace, 0);
    out.points[out.count++] = {closest.on_polyhedron, closest.distance - radius, feature};
  }
  for (std::uint32_t i = 0; i < out.count; ++i)
    out.points[i].position += (Real(0.5) * out.points[i].separation) * out.normal;
  return true;
}

/// From the polyhedron's frame, which lies at `origin` as seen from A's, to world axes.
PLUMB_HD inline void place(const Quat& q, const Vec& origin, Manifold& m) {
  m.normal = rotate(q, m.normal);
  for (std::uint32_t i = 0; i < m.count; ++i) m.points[i].position = origin + rotate(q, m.points[i].position);
}

/// The manifold with the polyhedron as first shape turned into that with it as second, A's origin being at -d from it.
PLUMB_HD inline void put_second(const Quat& q, const Vec& d, Manifold& m) {
  place(q, d, m);
  m.normal = -m.normal;
  for (std::uint32_t i = 0; i < m.count; ++i) m.points[i].feature = swapped_feature(m.points[i].feature);
}

}  // namespace round_polyhedron

PLUMB_HD inline bool collide_sphere_hull(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  const HullView view(hulls, pair.b.hull);
  const Real tie = kTie * (pair.a.reach + pair.b.reach);
  if (!round_polyhedron::touch(view, rotate_back(pair.qb, -pair.d), {0, 0, 0}, pair.a.size.x, pair.margin, tie, out))
    return false;
  round_polyhedron::put_second(pair.qb, pair.d, out);
  return true;
}

PLUMB_HD inline bool collide_box_capsule(const ShapePair& pair, const Hulls&, Manifold& out) {
  const Vec half = rotate_back(pair.qa, half_segment(pair.b, pair.qb)), centre = rotate_back(pair.qa, pair.d);
  const Real tie = kTie * (pair.a.reach + pair.b.reach);
  if (!round_polyhedron::touch(BoxView{pair.a.size}, centre - half, half + half, pair.b.size.x, pair.margin, tie, out))
    return false;
  round_polyhedron::place(pair.qa, {0, 0, 0}, out);
  return true;
}

PLUMB_HD inline bool collide_capsule_hull(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  const Vec half = rotate_back(pair.qb, half_segment(pair.a, pair.qa)), centre = rotate_back(pair.qb, -pair.d);
  const HullView view(hulls, pair.b.hull);
  const Real tie = kTie * (pair.a.reach + pair.b.reach);
  if (!round_polyhedron::touch(view, centre - half, half + half, pair.a.size.x, pair.margin, tie, out)) return false;
  round_polyhedron::put_second(pair.qb, pair.d, out);
  return true;
}

}  // namespace plumb::impulse
