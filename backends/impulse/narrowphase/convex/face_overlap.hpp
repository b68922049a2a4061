// Where two faces, or a face and a segment, lie over each other along the contact normal: the candidates for the points
// of contact, for polygons of any number of corners.
//
// Both are projected along the normal n into a plane across it. Every side of B's polygon is clipped against the
// half-planes of A's (Sutherland-Hodgman edge by edge, which for convex polygons needs no list of vertices), and
// corners of A within B's polygon are added. Each point knows its height above the plane on either face; the difference
// is its separation.
#pragma once

#include "geometry/shape.hpp"
#include "narrowphase/convex/candidates.hpp"
#include "narrowphase/convex/polyhedron.hpp"
#include "narrowphase/feature.hpp"

namespace plumb::impulse {

/// Axes of the plane across a normal; (x, y, n) is right-handed.
struct ContactPlane {
  Vec x, y, n;

  PLUMB_HD explicit ContactPlane(const Vec& normal) : x(perpendicular(normal)), y(cross(normal, x)), n(normal) {}
  /// Coordinates along x, y and n.
  PLUMB_HD Vec flatten(const Vec& p) const { return {dot(x, p), dot(y, p), dot(n, p)}; }
  PLUMB_HD Vec unflatten(const Vec& p) const { return p.x * x + p.y * y + p.z * n; }
};

/// The height over the contact plane of a face's plane.
struct FaceHeight {
  Vec normal;  ///< of the face, in coordinates of the contact plane
  Real offset;
  Real floor;  ///< lest a face that stands on edge be infinitely high: what it never exceeds

  PLUMB_HD Real at(Real px, Real py) const {
    const Real rise = offset - normal.x * px - normal.y * py;
    return abs(normal.z) > kParallel ? rise / normal.z : floor;
  }
};

/// The separations that a touch has room for, and where its points are kept.
struct Overlap {
  static constexpr int kMost = 16;
  Real deepest, margin, tie;
  Candidate at[kMost];
  int count = 0;

  PLUMB_HD void add(Real x, Real y, Real separation, std::uint32_t feature) {
    if (!(separation <= margin)) return;
    if (count == kMost) count = choose_points(at, count, tie);  // large faces: the best so far, then go on
    at[count++] = {x, y, max(separation, deepest), feature};
  }
};

/// A polyhedron's face as a polygon in the contact plane, counter-clockwise seen against the plane's normal.
template <class View>
struct FacePolygon {
  const View& view;
  std::uint32_t face;
  ContactPlane plane;
  Mat turn;  ///< takes the view's frame into that of the plane's axes
  Vec shift;
  bool reversed;  ///< the face looks against the plane's normal
  std::uint32_t size;

  PLUMB_HD std::uint32_t index(std::uint32_t k) const {
    const std::uint32_t wrapped = k >= size ? k - size : k;
    return view.loop(face, reversed ? size - 1 - wrapped : wrapped);
  }
  PLUMB_HD Vec corner(std::uint32_t k) const { return plane.flatten(turn * view.vertex(index(k)) + shift); }
  PLUMB_HD FaceHeight height() const {
    const Vec n = turn * view.normal(face);
    return {plane.flatten(n), view.offset(face) + dot(n, shift), plane.flatten(turn * view.vertex(index(0)) + shift).z};
  }
  /// How far outside of a side a point may be to count as within, times the side's length.
  PLUMB_HD Real slack() const {
    Real area = 0;
    const Vec first = corner(0);
    for (std::uint32_t k = 1; k + 1 < size; ++k) {
      const Vec p = corner(k) - first, q = corner(k + 1) - first;
      area += p.x * q.y - p.y * q.x;
    }
    return kClipSlack * abs(area) / static_cast<Real>(size);
  }
};

/// The parameters of p + s d within a polygon, and the sides through which it enters and leaves (or kUncut).
struct ClippedSide {
  static constexpr std::uint32_t kUncut = 0xffffffffU;
  Real s0 = 0, s1 = 1;
  std::uint32_t cut0 = kUncut, cut1 = kUncut;
  bool empty = false;
};

template <class View>
PLUMB_HD ClippedSide clip(const FacePolygon<View>& polygon, Real slack, const Vec& p, const Vec& d) {
  ClippedSide c;
  Vec from = polygon.corner(0);
  for (std::uint32_t k = 0; k < polygon.size; ++k) {
    const Vec to = polygon.corner(k + 1);
    const Real ex = to.x - from.x, ey = to.y - from.y;
    const Real begin = ex * (p.y - from.y) - ey * (p.x - from.x) + slack;
    const Real end = ex * (p.y + d.y - from.y) - ey * (p.x + d.x - from.x) + slack;
    from = to;
    if (begin < 0 && end < 0) {
      c.empty = true;
      return c;
    }
    if (begin < 0) {
      const Real s = begin / (begin - end);
      if (s > c.s0) {
        c.s0 = s;
        c.cut0 = k;
      }
    } else if (end < 0) {
      const Real s = begin / (begin - end);
      if (s < c.s1) {
        c.s1 = s;
        c.cut1 = k;
      }
    }
  }
  c.empty = c.s0 > c.s1;
  return c;
}

/// All points where B's face lies over A's.
template <class ViewA, class ViewB>
PLUMB_HD void overlap_faces(const FacePolygon<ViewA>& a, const FacePolygon<ViewB>& b, Overlap& out) {
  const FaceHeight height_a = a.height(), height_b = b.height();
  const Real slack_a = a.slack(), slack_b = b.slack();
  const std::uint32_t last_b = b.size - 1;

  std::uint32_t index_from = b.index(0);
  Vec from = b.corner(0);
  for (std::uint32_t k = 0; k <= last_b; ++k) {
    const std::uint32_t index_to = b.index(k + 1);
    const Vec to = b.corner(k + 1), d = to - from;
    const ClippedSide c = clip(a, slack_a, from, d);
    const std::uint32_t edge_b = edge_between(index_from, index_to);
    const auto add_crossing = [&](Real s, std::uint32_t cut) {
      const Vec p = from + s * d;
      out.add(p.x, p.y, p.z - height_a.at(p.x, p.y),
              feature_id(Part::kEdge, edge_between(a.index(cut), a.index(cut + 1)), Part::kEdge, edge_b));
    };
    if (!c.empty) {
      if (c.cut0 == ClippedSide::kUncut)
        out.add(from.x, from.y, from.z - height_a.at(from.x, from.y),
                feature_id(Part::kFace, a.face, Part::kVertex, index_from));
      else
        add_crossing(c.s0, c.cut0);
      if (c.cut1 != ClippedSide::kUncut) add_crossing(c.s1, c.cut1);
    }
    from = to;
    index_from = index_to;
  }

  for (std::uint32_t k = 0; k < a.size;
       ++k) {  // corners so well within B's face that no side of it gave the same point
    const Vec p = a.corner(k);
    bool within = true;
    Vec q = b.corner(0);
    for (std::uint32_t i = 0; i < b.size && within; ++i) {
      const Vec to = b.corner(i + 1);
      within = (to.x - q.x) * (p.y - q.y) - (to.y - q.y) * (p.x - q.x) > slack_b;
      q = to;
    }
    if (within)
      out.add(p.x, p.y, height_b.at(p.x, p.y) - p.z, feature_id(Part::kVertex, a.index(k), Part::kFace, b.face));
  }
}

}  // namespace plumb::impulse
