// The cylinder about the y axis of its frame: how far it reaches, what of it is nearest, and which part of it meets
// what lies along a contact normal. Its surface is round, not a polygon.
#pragma once

#include "narrowphase/convex/face_overlap.hpp"
#include "narrowphase/convex/segments.hpp"

namespace plumb::impulse {

namespace cylinder {

struct Cylinder {
  Real radius, half;

  /// The furthest that it reaches along n.
  PLUMB_HD Real reach(const Vec& n) const { return half * abs(n.y) + radius * sqrt(n.x * n.x + n.z * n.z); }
};

/// The part that is foremost along a normal.
enum class Part3 { kCap, kSide, kRim };
/// Sine of the angle to the axis' plane below which the side lies on what it touches; of caps kNearFace.
constexpr Real kNearSide = Real(0.1);
PLUMB_HD inline Part3 part_along(const Vec& n) {
  return abs(n.y) > kNearFace ? Part3::kCap : abs(n.y) < kNearSide ? Part3::kSide : Part3::kRim;
}

/// Across the axis, towards n; of unit length. Of a normal along the axis, the x axis.
PLUMB_HD inline Vec radial(const Vec& n) { return normalized_or({n.x, 0, n.z}, {1, 0, 0}); }
PLUMB_HD inline Real cap_height(const Cylinder& c, const Vec& n) { return n.y < 0 ? -c.half : c.half; }
/// The foremost point of the rim.
PLUMB_HD inline Vec rim_point(const Cylinder& c, const Vec& n) {
  const Vec u = radial(n);
  return {c.radius * u.x, cap_height(c, n), c.radius * u.z};
}

/// How far a point is outside, negative inside, and the way there from the nearest point of the surface.
struct Nearest {
  Vec normal;
  Real distance;
};
PLUMB_HD inline Nearest nearest(const Cylinder& c, const Vec& p) {
  const Real across = sqrt(p.x * p.x + p.z * p.z);
  const Vec u = radial(p);
  const Real out_side = across - c.radius, out_cap = abs(p.y) - c.half;
  const Vec up = {0, p.y < 0 ? Real(-1) : Real(1), 0};
  if (out_side > 0 && out_cap > 0) {
    const Real distance = sqrt(out_side * out_side + out_cap * out_cap);
    return {(1 / distance) * (out_side * u + out_cap * up), distance};
  }
  return out_side > out_cap ? Nearest{u, out_side} : Nearest{up, out_cap};
}

/// The part of p + [0, 1] d above a cap's disc, or beside the side between both caps. False: none.
PLUMB_HD inline bool part_over(const Cylinder& c, Part3 part, const Vec& p, const Vec& d, Real& s0, Real& s1) {
  s0 = 0;
  s1 = 1;
  if (part == Part3::kSide) {
    const Real limit = c.half * (1 + kClipSlack);
    if (d.y == 0) return abs(p.y) <= limit;
    const Real a = (-limit - p.y) / d.y, b = (limit - p.y) / d.y;
    s0 = max(s0, min(a, b));
    s1 = min(s1, max(a, b));
    return s0 <= s1;
  }
  const Real limit = c.radius * (1 + kClipSlack);
  const Real aa = d.x * d.x + d.z * d.z, ab = p.x * d.x + p.z * d.z, bb = p.x * p.x + p.z * p.z - limit * limit;
  if (!(aa > 0)) return bb <= 0;
  const Real square = ab * ab - aa * bb;
  if (square < 0) return false;
  const Real root = sqrt(square);
  s0 = max(s0, (-ab - root) / aa);
  s1 = min(s1, (-ab + root) / aa);
  return s0 <= s1;
}

/// What of another shape is foremost against the normal, where it is no face that lies on the cylinder: an edge p + [0,
/// 1] d or, with d 0, a corner; with a radius about it. Its distances are along the normal n, of which the shortest is
/// `separation` + radius. Adds one point, or two where the edge lies along the cylinder.
PLUMB_HD inline void touch_edge(const Cylinder& c, const Vec& n, const Vec& p, const Vec& d, Real radius,
                                Real separation, Real margin, Manifold& out) {
  const auto add = [&](const Vec& on_other, Real s, std::uint32_t feature) {
    if (s <= margin) out.points[out.count++] = {on_other - (radius + Real(0.5) * s) * n, s, feature};
  };
  const Part3 part = part_along(n);
  const Real long_d = length(d), rise = abs(dot(n, d));
  const bool level = long_d > 0 && rise <= Real(0.05) * long_d;
  const bool lies = level && (part == Part3::kCap || (part == Part3::kSide && abs(d.y) >= kNearFace * long_d));
  Real s0, s1;
  if (lies && part_over(c, part, p, d, s0, s1) && s1 > s0) {
    // Heights over the foremost of the cylinder in the direction n, at both ends.
    const Real from = dot(n, p) - c.reach(n) - radius, along = dot(n, d);
    const Real first = max(from + s0 * along, separation), last = max(from + s1 * along, separation);
    if (min(first, last) <= separation + kClipSlack * (long_d + c.radius)) {  // else its deepest point is between
      add(p + s0 * d, first, 1);
      add(p + s1 * d, last, 2);
      if (out.count != 0) return;
    }
  }
  if (part == Part3::kRim) {
    out.count = 0;
    if (separation <= margin) {
      out.count = 1;
      out.points[0] = {rim_point(c, n) + (Real(0.5) * separation) * n, separation, 3};
    }
    return;
  }
  Real s = 0;
  if (long_d > 0) {
    if (part == Part3::kSide) {
      const Vec u = c.radius * radial(n);
      s = closest_between({u.x, -c.half, u.z}, {0, 2 * c.half, 0}, p, d).r;
    } else {
      s = dot(n, d) < 0 ? Real(1) : Real(0);
      if (level && part_over(c, part, p, d, s0, s1)) s = Real(0.5) * (s0 + s1);
    }
  }
  add(p + s * d, separation, 4);
}

/// Another shape's face that looks at the cylinder: n is its normal turned round, or close to that. one_of_many: the
/// face goes on in others; then points of the cylinder's own are put before those where the face ends.
template <class View>
PLUMB_HD void touch_face(const Cylinder& c, const Vec& n, const FacePolygon<View>& polygon, bool one_of_many,
                         Real separation, Real margin, Real tie, Manifold& out) {
  const ContactPlane& plane = polygon.plane;
  const FaceHeight height = polygon.height();
  const Real slack = polygon.slack();
  Overlap overlap;
  overlap.deepest = separation;
  overlap.margin = margin;
  overlap.tie = tie;
  const auto is_over = [&](const Vec& p) {
    Vec from = polygon.corner(0);
    for (std::uint32_t k = 0; k < polygon.size; ++k) {
      const Vec to = polygon.corner(k + 1);
      if ((to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x) < -slack) return false;
      from = to;
    }
    return true;
  };
  const auto add_own = [&](const Vec& point, std::uint32_t feature) {
    const Vec p = plane.flatten(point);
    if (is_over(p))
      overlap.add(p.x, p.y, height.at(p.x, p.y) - p.z, feature_id(Part::kVertex, feature, Part::kFace, 0));
  };
  int own = 0;
  const Part3 part = part_along(n);
  if (part == Part3::kRim) {
    add_own(rim_point(c, n), 0);
  } else if (part == Part3::kSide) {
    const Vec u = c.radius * radial(n);
    const Vec from = plane.flatten({u.x, -c.half, u.z}), along = plane.flatten({0, 2 * c.half, 0});
    const ClippedSide clipped = clip(polygon, slack, from, along);
    if (!clipped.empty) {
      for (int end = 0; end < 2; ++end) {
        const Vec p = from + (end == 0 ? clipped.s0 : clipped.s1) * along;
        const bool cut = one_of_many && (end == 0 ? clipped.cut0 : clipped.cut1) != ClippedSide::kUncut;
        overlap.add(p.x, p.y, height.at(p.x, p.y) - p.z,
                    feature_id(Part::kEdge, static_cast<std::uint32_t>(end), cut ? Part::kEdge : Part::kFace, 0));
      }
    }
  } else {
    const Real y = cap_height(c, n), tilt = sqrt(n.x * n.x + n.z * n.z);
    const bool level = tilt <= kLevel;
    const Real ux = level ? c.radius : c.radius * n.x / tilt, uz = level ? Real(0) : c.radius * n.z / tilt;
    add_own({ux, y, uz}, 0);
    add_own({-uz, y, ux}, 1);
    add_own({-ux, y, -uz}, 2);
    add_own({uz, y, -ux}, 3);
    own = overlap.count;
    // The face's corners and sides over the disc: along n, onto the cap.
    const auto onto_cap = [&](const Vec& flat) {
      const Vec w = plane.unflatten(flat);
      const Real t = (w.y - y) / n.y;
      return Vec{w.x - t * n.x, t, w.z - t * n.z};  // t: how far above the cap
    };
    Vec from_flat = polygon.corner(0), from = onto_cap(from_flat);
    for (std::uint32_t k = 0; k < polygon.size; ++k) {
      const Vec to_flat = polygon.corner(k + 1), to = onto_cap(to_flat), d = to - from;
      const std::uint32_t name = polygon.index(k);
      const Real aa = d.x * d.x + d.z * d.z, ab = from.x * d.x + from.z * d.z;
      const Real bb = from.x * from.x + from.z * from.z - c.radius * c.radius;
      if (bb < 0) overlap.add(from_flat.x, from_flat.y, from.y, feature_id(Part::kFace, 0, Part::kVertex, name));
      if (const Real square = ab * ab - aa * bb; square > 0 && aa > 0) {
        const Real root = sqrt(square);
        for (int side = 0; side < 2; ++side) {
          const Real s = (side == 0 ? -ab - root : -ab + root) / aa;
          if (s > 0 && s < 1)
            overlap.add(from_flat.x + s * (to_flat.x - from_flat.x), from_flat.y + s * (to_flat.y - from_flat.y),
                        from.y + s * d.y,
                        feature_id(Part::kEdge, 2 + static_cast<std::uint32_t>(side), Part::kEdge, name));
        }
      }
      from_flat = to_flat;
      from = to;
    }
  }
  const int count = choose_points(overlap.at, overlap.count, tie, one_of_many ? max(own, 1) : 1);
  out.count = static_cast<std::uint32_t>(count);
  for (int i = 0; i < count; ++i) {
    const Candidate& at = overlap.at[i];
    const Real middle = height.at(at.x, at.y) - Real(0.5) * at.separation;
    out.points[i] = {plane.unflatten({at.x, at.y, middle}), at.separation, at.feature};
  }
}

}  // namespace cylinder

}  // namespace plumb::impulse
