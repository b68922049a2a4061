// Two polyhedra (boxes, hulls): the separating axis test over the faces of both and over those pairs of edges that make
// a face of the Minkowski difference, which their arcs on the Gauss map tell (Gregorius, "The Separating Axis Test
// between Convex Polyhedra", GDC 2013); then the overlap of the two faces that look at each other, as for boxes
// (box_box.hpp).
#pragma once

#include "math/bits.hpp"
#include "math/mat33.hpp"
#include "narrowphase/convex/face_overlap.hpp"
#include "narrowphase/convex/segments.hpp"

namespace plumb::impulse {

namespace polyhedra {

/// Where B is, in A's frame.
struct Placement {
  Mat turn;
  Vec shift;
};

struct ContactAxis {
  Vec normal;  ///< unit, from A to B, in A's frame
  Real separation = -kHuge;
  std::uint32_t a = 0, b = 0;  ///< the face, or both edges
  enum class Kind { kFaceOfA, kFaceOfB, kEdges } kind = Kind::kFaceOfA;
};

constexpr Mat kNoTurn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The gap between the supports of both along n: true for every direction n, however it was found.
template <class ViewA, class ViewB>
PLUMB_HD Real gap_along(const ViewA& a, const ViewB& b, const Placement& at, const Vec& n) {
  const Vec n_b = multiply_transposed(at.turn, n);
  return dot(n, at.shift) + dot(n_b, b.vertex(b.support(-n_b))) - dot(n, a.vertex(a.support(n)));
}

/// What bounds separations from above without a look at the vertices: each polyhedron holds a ball about its centre, so
/// along n they are no further apart than those balls.
struct Balls {
  Vec apart;     ///< from A's centre to B's
  Vec centre_b;  ///< in A's frame
  Real radius_a, radius_b;

  template <class ViewA, class ViewB>
  PLUMB_HD Balls(const ViewA& a, const ViewB& b, const Placement& at)
      : centre_b(at.turn * b.centre() + at.shift), radius_a(a.inner_radius()), radius_b(b.inner_radius()) {
    apart = centre_b - a.centre();
  }
  /// Whether some direction between two adjacent face normals may separate by more than `beaten`.
  PLUMB_HD bool may_separate(const Vec& left, const Vec& right, Real beaten) const {
    const Real least = beaten + radius_a + radius_b;
    if (least <= 0) return true;
    const Real most = max(dot(left, apart), dot(right, apart));
    // On the arc between the normals a component is at most the greater one over the cosine of half their angle.
    return most > 0 && 2 * most * most > least * least * (1 + dot(left, right));
  }
};

/// False as soon as one separates by more than margin, which is the best then.
template <class ViewA, class ViewB>
PLUMB_HD bool find_face_axes(const ViewA& a, const ViewB& b, const Placement& at, const Balls& balls, Real margin,
                             Real tie, ContactAxis& best) {
  for (std::uint32_t f = 0; f < a.face_count(); ++f) {
    const Vec n = a.normal(f);
    if (dot(n, balls.centre_b) - a.offset(f) - balls.radius_b <= best.separation) continue;
    const Vec n_b = multiply_transposed(at.turn, n);
    const Real s = dot(n, at.shift) + dot(n_b, b.vertex(b.support(-n_b))) - a.offset(f);
    if (s > margin || s > best.separation + tie) best = {n, s, f, 0, ContactAxis::Kind::kFaceOfA};
    if (s > margin) return false;
  }
  for (std::uint32_t f = 0; f < b.face_count(); ++f) {
    const Vec n = at.turn * b.normal(f);
    const Real offset = b.offset(f) + dot(n, at.shift);
    if (dot(n, a.centre()) - offset - balls.radius_a <= best.separation) continue;
    const Real s = dot(n, a.vertex(a.support(-n))) - offset;
    if (s > margin || s > best.separation + tie) best = {-n, s, 0, f, ContactAxis::Kind::kFaceOfB};
    if (s > margin) return false;
  }
  return true;
}

/// An edge of B in A's frame.
struct EdgeOfB {
  std::uint32_t number;
  Vec from, along;
  Vec left, right;  ///< inward normals of the faces between which it is
};

/// The axis of edge i of A and an edge of B, if they make a face of the Minkowski difference and it separates more than
/// the best axis so far.
template <class ViewA, class ViewB>
PLUMB_HD void try_edges(const ViewA& a, const ViewB& b, const Placement& at, std::uint32_t i, const EdgeOfB& edge_b,
                        Real tie, ContactAxis& best) {
  const HullEdge edge_a = a.edge(i);
  const Vec from_a = a.vertex(edge_a.from), e_a = a.vertex(edge_a.to) - from_a;
  // The arcs cross: the ends of each lie on different sides of the other, and in the same hemisphere.
  const Real l = dot(edge_b.left, e_a), r = dot(edge_b.right, e_a);
  if (!(l * r < 0)) return;
  const Vec left_a = a.normal(edge_a.left), right_a = a.normal(edge_a.right);
  const Real m = dot(left_a, edge_b.along), k = dot(right_a, edge_b.along);
  if (!(m * k < 0) || !(l * k > 0)) return;

  Vec n = cross(e_a, edge_b.along);
  const Real square = length_squared(n);
  if (square <= kParallel * kParallel * length_squared(e_a) * length_squared(edge_b.along)) return;
  n = ((dot(n, left_a + right_a) < 0 ? Real(-1) : Real(1)) / sqrt(square)) * n;
  if (dot(n, edge_b.from - from_a) <= best.separation + tie) return;
  const Real s = gap_along(a, b, at, n);  // of edges near parallel, n may not be quite at right angles to both
  if (s > best.separation + tie) best = {n, s, i, edge_b.number, ContactAxis::Kind::kEdges};
}

template <class ViewA, class ViewB>
PLUMB_HD bool find_edge_axes(const ViewA& a, const ViewB& b, const Placement& at, const Balls& balls, Real margin,
                             Real tie, ContactAxis& best) {
  for (std::uint32_t first = 0; first < a.edge_count(); first += 64) {  // in sets of 64, so that a word holds a set
    std::uint64_t of_a = 0;
    for (std::uint32_t i = 0; i < 64 && first + i < a.edge_count(); ++i) {
      const HullEdge edge = a.edge(first + i);
      if (balls.may_separate(a.normal(edge.left), a.normal(edge.right), best.separation)) of_a |= std::uint64_t{1} << i;
    }
    for (std::uint32_t j = 0; j < b.edge_count() && of_a != 0; ++j) {
      const HullEdge edge = b.edge(j);
      const Vec left = -(at.turn * b.normal(edge.left)), right = -(at.turn * b.normal(edge.right));
      if (!balls.may_separate(left, right, best.separation)) continue;
      const Vec from = at.turn * b.vertex(edge.from) + at.shift;
      const EdgeOfB edge_b = {j, from, at.turn * b.vertex(edge.to) + at.shift - from, left, right};
      for (std::uint64_t rest = of_a; rest != 0; rest &= rest - 1)
        try_edges(a, b, at, first + static_cast<std::uint32_t>(trailing_zeros(rest)), edge_b, tie, best);
      if (best.separation > margin) return false;
    }
  }
  return true;
}

/// One point, where the edges of an edge axis come closest; none where they pass each other by.
template <class ViewA, class ViewB>
PLUMB_HD void touch_edges(const ViewA& a, const ViewB& b, const Placement& at, const ContactAxis& axis, Manifold& out) {
  const HullEdge edge_a = a.edge(axis.a), edge_b = b.edge(axis.b);
  const Vec p = a.vertex(edge_a.from), q = at.turn * b.vertex(edge_b.from) + at.shift;
  const Vec along_a = a.vertex(edge_a.to) - p, along_b = at.turn * b.vertex(edge_b.to) + at.shift - q;
  const ClosestPair closest = closest_between(p, along_a, q, along_b);
  const Vec across = closest.on_b - closest.on_a - axis.separation * axis.normal;
  const Real most = kClipSlack * kClipSlack * max(length_squared(along_a), length_squared(along_b));
  if (axis.separation > 0 && length_squared(across) > most) return;
  out.count = 1;
  out.points[0] = {
      Real(0.5) * (closest.on_a + closest.on_b), axis.separation,
      feature_id(Part::kEdge, edge_between(edge_a.from, edge_a.to), Part::kEdge, edge_between(edge_b.from, edge_b.to))};
}

/// The corner that a face axis separates from the face, where it is not among the candidates: it need not belong to the
/// face that looks at the other one most squarely.
template <class ViewA, class ViewB>
PLUMB_HD void add_support(const ViewA& a, const ViewB& b, const Placement& at, const ContactAxis& axis,
                          std::uint32_t face_a, std::uint32_t face_b, const ContactPlane& plane, Overlap& overlap) {
  for (int i = 0; i < overlap.count; ++i)
    if (overlap.at[i].separation <= axis.separation + overlap.tie) return;
  if (axis.kind == ContactAxis::Kind::kFaceOfA) {
    const std::uint32_t v = b.support(-multiply_transposed(at.turn, axis.normal));
    const Vec p = plane.flatten(at.turn * b.vertex(v) + at.shift);
    overlap.add(p.x, p.y, axis.separation, feature_id(Part::kFace, face_a, Part::kVertex, v));
  } else {
    const std::uint32_t v = a.support(axis.normal);
    const Vec p = plane.flatten(a.vertex(v));
    overlap.add(p.x, p.y, axis.separation, feature_id(Part::kVertex, v, Part::kFace, face_b));
  }
}

/// In A's frame.
template <class ViewA, class ViewB>
PLUMB_HD bool touch(const ViewA& a, const ViewB& b, const Placement& at, Real margin, Real tie, Manifold& out) {
  using Kind = ContactAxis::Kind;
  out.count = 0;
  ContactAxis axis;
  const Balls balls(a, b, at);
  if (!find_face_axes(a, b, at, balls, margin, tie, axis) || !find_edge_axes(a, b, at, balls, margin, tie, axis)) {
    out.gap = axis.separation;
    return false;
  }
  out.normal = axis.normal;

  const Vec against_b = -multiply_transposed(at.turn, axis.normal);
  std::uint32_t face_a = axis.a, face_b = axis.b;
  if (axis.kind == Kind::kEdges) {
    face_a = face_at_edge(a, axis.a, axis.normal);
    face_b = face_at_edge(b, axis.b, against_b);
  } else if (axis.kind == Kind::kFaceOfA) {
    face_b = face_at_support(b, against_b);
  } else {
    face_a = face_at_support(a, axis.normal);
  }
  if (axis.kind == Kind::kEdges && dot(a.normal(face_a), axis.normal) < kNearFace &&
      dot(b.normal(face_b), against_b) < kNearFace) {
    touch_edges(a, b, at, axis, out);
    return out.count != 0;
  }

  const ContactPlane plane(axis.normal);
  const FacePolygon<ViewA> polygon_a = {a, face_a, plane, kNoTurn, {0, 0, 0}, false, a.loop_size(face_a)};
  const FacePolygon<ViewB> polygon_b = {b, face_b, plane, at.turn, at.shift, true, b.loop_size(face_b)};
  Overlap overlap;
  overlap.deepest = axis.separation;
  overlap.margin = margin;
  overlap.tie = tie;
  overlap_faces(polygon_a, polygon_b, overlap);
  if (axis.separation <= 0 && axis.kind != Kind::kEdges) add_support(a, b, at, axis, face_a, face_b, plane, overlap);
  int count = choose_points(overlap.at, overlap.count, tie);
  out.count = static_cast<std::uint32_t>(count);
  const bool on_b = axis.kind == Kind::kFaceOfB;  // heights are best over the face across the normal
  const FaceHeight height = on_b ? polygon_b.height() : polygon_a.height();
  for (int i = 0; i < count; ++i) {
    const Candidate& c = overlap.at[i];
    // What is deepest along the axis is a candidate, but for the last digits and the slack of clipping.
    const Real separation = i == 0 && axis.separation <= 0 ? axis.separation : c.separation;
    const Real middle = height.at(c.x, c.y) + (on_b ? Real(-0.5) : Real(0.5)) * separation;
    out.points[i] = {plane.unflatten({c.x, c.y, middle}), separation, c.feature};
  }
  return out.count != 0;
}

template <class ViewA, class ViewB>
PLUMB_HD bool collide_views(const ViewA& view_a, const ViewB& view_b, const ShapePair& pair, Manifold& out) {
  const Placement at = {to_matrix(conjugate(pair.qa) * pair.qb), rotate_back(pair.qa, pair.d)};
  if (!touch(view_a, view_b, at, pair.margin, kTie * (pair.a.reach + pair.b.reach), out)) return false;
  out.normal = rotate(pair.qa, out.normal);
  for (std::uint32_t i = 0; i < out.count; ++i) out.points[i].position = rotate(pair.qa, out.points[i].position);
  return true;
}

}  // namespace polyhedra

PLUMB_HD inline bool collide_box_hull(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  return polyhedra::collide_views(BoxView{pair.a.size}, HullView(hulls, pair.b.hull), pair, out);
}

PLUMB_HD inline bool collide_hull_hull(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  return polyhedra::collide_views(HullView(hulls, pair.a.hull), HullView(hulls, pair.b.hull), pair, out);
}

}  // namespace plumb::impulse
