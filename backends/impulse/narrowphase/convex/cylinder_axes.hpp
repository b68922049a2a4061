// The axis across which a cylinder and another shape are furthest apart.
//
// What decides it is either a direction that is known (a face's normal, the cylinder's own axis, the way from its
// surface to a corner) or lies between two known ones, where the rim or the side meets an edge: there the gap has one
// greatest value, which golden section finds. Every direction that is tried separates truly by the gap that is told.
#pragma once

#include "narrowphase/convex/cylinder.hpp"
#include "narrowphase/convex/polyhedra.hpp"

namespace plumb::impulse {

namespace cylinder {

struct Axis {
  Vec normal;  ///< unit, from the cylinder outward
  Real separation = -kHuge;
  enum class Kind { kFace, kCap, kCorner, kEdge } kind = Kind::kFace;
  std::uint32_t feature = 0;  ///< face, corner or edge of the other shape
};

constexpr Real kGolden = Real(0.61803398874989485);
constexpr int kSections = sizeof(Real) == 8 ? 36 : 20;

/// The gap to an edge through v along directions between two.
struct EdgeGap {
  const Cylinder& c;
  Vec v, from, to;  ///< from, to: not of unit length where they need not be

  PLUMB_HD Vec direction(Real s) const { return normalized_or((1 - s) * from + s * to, from); }
  PLUMB_HD Real at(Real s) const {
    const Vec n = direction(s);
    return dot(n, v) - c.reach(n);
  }
  /// The parameter of the greatest gap.
  PLUMB_HD Real widest() const {
    Real low = 0, high = 1;
    Real s = high - kGolden * (high - low), r = low + kGolden * (high - low);
    Real at_s = at(s), at_r = at(r);
    for (int i = 0; i < kSections; ++i) {
      if (at_s > at_r) {
        high = r;
        r = s;
        at_r = at_s;
        s = high - kGolden * (high - low);
        at_s = at(s);
      } else {
        low = s;
        s = r;
        at_s = at_r;
        r = low + kGolden * (high - low);
        at_r = at(r);
      }
    }
    Real best = Real(0.5) * (low + high);
    // Where the direction passes from one cap to the other the gap has a kink, and the side its line.
    const Real kink = from.y * to.y < 0 ? from.y / (from.y - to.y) : best;
    if (at(kink) >= at(best)) best = kink;
    return best;
  }
};

/// Whether on all directions from a face's normal `near` to that of its neighbour `far`, turned by no more than a right
/// angle, the gap to their edge through v is no greater than at `near`. Turning by t changes n . v by no more than
/// sin t (far . v - sqrt(2) min(near . v, 0)) over the sine of the angle between the two, and the cylinder's reach by
/// no more than sqrt(2) sin t times the distance of its rim.
PLUMB_HD inline bool narrows_from(const Cylinder& c, const Vec& v, const Vec& near, const Vec& far) {
  constexpr Real kMore = Real(1.5);  // than sqrt(2)
  return dot(far, v) - kMore * min(dot(near, v), Real(0)) + kMore * (c.radius + c.half) < 0;
}

/// Edges; points are those of the view, placed. arc(e, v, from, to): between which directions the edge e, which goes
/// through v, decides; false where it does not.
template <class View, class Arc>
PLUMB_HD bool try_edges(const Cylinder& c, const View& view, const polyhedra::Placement& at, const Arc& arc,
                        Real margin, Real tie, Axis& best) {
  for (std::uint32_t e = 0; e < view.edge_count(); ++e) {
    const HullEdge edge = view.edge(e);
    const Vec p = at.turn * view.vertex(edge.from) + at.shift, q = at.turn * view.vertex(edge.to) + at.shift;
    // No axis of this edge separates by more than its distance from the cylinder's centre.
    const Vec d = q - p;
    const Real nearest_to_centre = length(p + closest_on_segment(p, d, {0, 0, 0}) * d);
    if (nearest_to_centre - min(c.radius, c.half) <= best.separation + tie) continue;
    EdgeGap gap{c, p, {}, {}};
    if (!arc(e, p, gap.from, gap.to)) continue;
    const Real s = gap.widest(), separation = gap.at(s);
    if (separation > margin) return false;
    if (separation > best.separation + tie) best = {gap.direction(s), separation, Axis::Kind::kEdge, e};
  }
  return true;
}

/// Corners and caps.
template <class View>
PLUMB_HD bool try_corners(const Cylinder& c, const View& view, const polyhedra::Placement& at, Real margin, Real tie,
                          Axis& best) {
  const auto gap = [&](const Vec& n) {
    const std::uint32_t v = view.support(-multiply_transposed(at.turn, n));
    return dot(n, at.turn * view.vertex(v) + at.shift) - c.reach(n);
  };
  for (int cap = 0; cap < 2; ++cap) {
    const Vec n = {0, cap == 0 ? Real(-1) : Real(1), 0};
    const Real s = gap(n);
    if (s > margin) return false;
    if (s > best.separation + tie) best = {n, s, Axis::Kind::kCap, 0};
  }
  for (std::uint32_t v = 0; v < view.vertex_count(); ++v) {
    const Nearest near = nearest(c, at.turn * view.vertex(v) + at.shift);
    if (near.distance <= best.separation + tie) continue;
    const Real s = gap(near.normal);
    if (s > margin) return false;
    if (s > best.separation + tie) best = {near.normal, s, Axis::Kind::kCorner, v};
  }
  return true;
}

/// Of a box or a hull. False when an axis separates by more than margin.
template <class View>
PLUMB_HD bool find_axis(const Cylinder& c, const View& view, const polyhedra::Placement& at, Real margin, Real tie,
                        Axis& best) {
  for (std::uint32_t f = 0; f < view.face_count(); ++f) {
    const Vec n = -(at.turn * view.normal(f));
    const Real s = dot(n, at.shift) - view.offset(f) - c.reach(n);
    if (s > margin) return false;
    if (s > best.separation + tie) best = {n, s, Axis::Kind::kFace, f};
  }
  if (!try_corners(c, view, at, margin, tie, best)) return false;
  // What is far beyond one of an edge's faces meets the other, as wheels meet the ground: that has been tried.
  const auto arc = [&](std::uint32_t e, const Vec& v, Vec& from, Vec& to) {
    const HullEdge edge = view.edge(e);
    from = -(at.turn * view.normal(edge.left));
    to = -(at.turn * view.normal(edge.right));
    const bool turns_far = dot(from, to) < -kParallel;
    return turns_far || !(narrows_from(c, v, from, to) || narrows_from(c, v, to, from));
  };
  return try_edges(c, view, at, arc, margin, tie, best);
}

}  // namespace cylinder

}  // namespace plumb::impulse
