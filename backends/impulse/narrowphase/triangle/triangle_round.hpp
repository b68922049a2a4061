// Spheres and capsules against a triangle of a surface, in the surface's frame; the surface is the first shape.
#pragma once

#include "narrowphase/convex/segments.hpp"
#include "narrowphase/feature.hpp"
#include "narrowphase/manifold.hpp"
#include "narrowphase/triangle/triangle_side.hpp"

namespace plumb::impulse {

namespace surface {

/// Of the radius: how far beside a triangle a point still counts as over it. More than what kAlongPlane lets pass, so
/// that nothing falls between two triangles of a plane.
constexpr Real kBeside = Real(8e-3);

/// Where a segment, or a point, comes closest to the triangle's edges.
struct ClosestEdge {
  Vec on_triangle, away;
  Real distance = kHuge;
  int edge = 0;
  int corner = -1;  ///< that of the triangle, where the closest point is one
};

PLUMB_HD inline ClosestEdge closest_edge(const Triangle& t, const Vec& p, const Vec& d) {
  ClosestEdge best;
  for (int k = 0; k < 3; ++k) {
    const int next = k == 2 ? 0 : k + 1;
    const ClosestPair pair = closest_between(t.at[k], t.at[next] - t.at[k], p, d);
    const Vec away = pair.on_b - pair.on_a;
    const Real distance = length(away);
    if (distance < best.distance) best = {pair.on_a, away, distance, k, pair.s == 0 ? k : pair.s == 1 ? next : -1};
  }
  return best;
}

/// The part of p + [0, 1] d that lies over the triangle. False: none.
PLUMB_HD inline bool part_over(const TriangleSide& side, const Vec& p, const Vec& d, Real slack, Real& s0, Real& s1) {
  s0 = 0;
  s1 = 1;
  for (int k = 0; k < 3; ++k) {
    const Vec out = side.outward(k);
    const Real begin = dot(out, p - side.triangle.at[k]) - slack * length(out), end = begin + dot(out, d);
    if (begin > 0 && end > 0) return false;
    if (begin > 0)
      s0 = max(s0, begin / (begin - end));
    else if (end > 0)
      s1 = min(s1, begin / (begin - end));
  }
  return s0 <= s1;
}

/// A ball or capsule of the given radius about p + [0, 1] d.
template <class Surface>
PLUMB_HD bool touch_round(const Surface& on, std::uint32_t t, const Vec& p, const Vec& d, Real radius, Real margin,
                          Manifold& out) {
  out.count = 0;
  TriangleSide side(on.triangle(t));
  const Vec middle = p + Real(0.5) * d;
  const Real from = side.height(p), to = side.height(p + d);
  if (!choose_side(on, middle, min(from, to) - radius, max(from, to) + radius, side)) return false;
  const Real h0 = side.reversed ? -from : from, h1 = side.reversed ? -to : to;
  if (min(h0, h1) - radius > margin) return false;

  const auto add = [&](const Vec& on_triangle, Real separation, std::uint32_t feature) {
    if (separation <= margin)
      out.points[out.count++] = {on_triangle + (Real(0.5) * separation) * out.normal, separation, feature};
  };
  out.normal = side.normal;
  Real s0, s1, lowest = kHuge;
  const bool over = part_over(side, p, d, kBeside * radius, s0, s1);
  if (over) lowest = min(h0 + s0 * (h1 - h0), h0 + s1 * (h1 - h0));
  if (lowest > 0) {  // else it goes through, and only the plane knows the way out
    const ClosestEdge closest = closest_edge(side.triangle, p, d);
    if (closest.distance < lowest - kBeside * radius) {
      const Vec direction = normalized_or(closest.away, side.normal);
      const Real rise = closest.corner >= 0 ? rise_at_corner(on, side.triangle.corner[closest.corner], direction)
                                            : rise_at_edge(on, t, side.triangle, closest.edge, direction);
      if (rise <= kAlongPlane) {
        out.normal = direction;
        add(closest.on_triangle, closest.distance - radius,
            16U + static_cast<std::uint32_t>(closest.corner >= 0 ? 4 + closest.corner : closest.edge));
        return out.count != 0;
      }
    }
  }
  if (!over) return false;
  const auto add_end = [&](Real s, std::uint32_t feature) {
    const Vec at = p + s * d;
    const Real h = h0 + s * (h1 - h0);
    add(at - h * side.normal, h - radius, feature);
  };
  add_end(s0, s0 > 0 ? 2U : feature_id(Part::kFace, 0, Part::kVertex, 0));
  if (length_squared(d) * (s1 - s0) * (s1 - s0) > 0)
    add_end(s1, s1 < 1 ? 3U : feature_id(Part::kFace, 0, Part::kVertex, 1));
  return out.count != 0;
}

}  // namespace surface

}  // namespace plumb::impulse
