// Boxes and convex hulls seen as the same thing: vertices, faces with loops, edges between two faces. The pair
// functions on polyhedra are templates over these views.
#pragma once

#include "geometry/shape.hpp"
#include "geometry/tolerance.hpp"

namespace plumb::impulse {

/// A hull of the pool.
struct HullView {
  HullRange range;
  const Vec* vertices;
  const HullFace* faces;
  const std::uint32_t* loops;
  const HullEdge* edges;

  PLUMB_HD HullView(const Hulls& hulls, std::uint32_t row)
      : range(hulls.ranges[row]),
        vertices(hulls.vertices + range.first_vertex),
        faces(hulls.faces + range.first_face),
        loops(hulls.loops + range.first_loop),
        edges(hulls.edges + range.first_edge) {}

  PLUMB_HD std::uint32_t vertex_count() const { return range.vertex_count; }
  PLUMB_HD std::uint32_t face_count() const { return range.face_count; }
  PLUMB_HD std::uint32_t edge_count() const { return range.edge_count; }
  PLUMB_HD Vec centre() const { return range.centre; }
  PLUMB_HD Real inner_radius() const { return range.inner_radius; }
  PLUMB_HD Vec vertex(std::uint32_t v) const { return vertices[v]; }
  PLUMB_HD Vec normal(std::uint32_t f) const { return faces[f].normal; }
  PLUMB_HD Real offset(std::uint32_t f) const { return faces[f].offset; }
  PLUMB_HD HullEdge edge(std::uint32_t e) const { return edges[e]; }
  PLUMB_HD std::uint32_t loop_size(std::uint32_t f) const { return faces[f].count; }
  PLUMB_HD std::uint32_t loop(std::uint32_t f, std::uint32_t k) const { return loops[faces[f].first + k]; }
  /// The vertex furthest along n.
  PLUMB_HD std::uint32_t support(const Vec& n) const {
    std::uint32_t best = 0;
    Real most = dot(n, vertices[0]);
    for (std::uint32_t v = 1; v < range.vertex_count; ++v)
      if (const Real s = dot(n, vertices[v]); s > most) {
        most = s;
        best = v;
      }
    return best;
  }
};

/// A box made up as it is asked. Vertex v lies on the positive side of axis k where bit k of v is set; face 2 k + 1 is
/// across axis k on its positive side; edge 4 k + i runs along axis k.
struct BoxView {
  Vec half;

  PLUMB_HD std::uint32_t vertex_count() const { return 8; }
  PLUMB_HD std::uint32_t face_count() const { return 6; }
  PLUMB_HD std::uint32_t edge_count() const { return 12; }
  PLUMB_HD Vec centre() const { return {0, 0, 0}; }
  PLUMB_HD Real inner_radius() const { return min(min(half.x, half.y), half.z); }
  PLUMB_HD Vec vertex(std::uint32_t v) const {
    return {(v & 1U) != 0 ? half.x : -half.x, (v & 2U) != 0 ? half.y : -half.y, (v & 4U) != 0 ? half.z : -half.z};
  }
  PLUMB_HD Vec normal(std::uint32_t f) const {
    Vec n = {0, 0, 0};
    n[static_cast<int>(f >> 1U)] = (f & 1U) != 0 ? Real(1) : Real(-1);
    return n;
  }
  PLUMB_HD Real offset(std::uint32_t f) const { return half[static_cast<int>(f >> 1U)]; }
  PLUMB_HD HullEdge edge(std::uint32_t e) const {
    const std::uint32_t along = e >> 2U, u = along == 2 ? 0 : along + 1, v = along == 0 ? 2 : along - 1;
    const std::uint32_t on_u = e & 1U, on_v = (e >> 1U) & 1U;
    const std::uint32_t from = (on_u << u) | (on_v << v), to = from | (1U << along);
    // Along, u, v are right-handed: the face on u's positive side is turned around from v to `along`, so its loop runs
    // with the axis along its side at +v.
    const std::uint32_t across_u = 2 * u + on_u, across_v = 2 * v + on_v;
    return on_u == on_v ? HullEdge{from, to, across_u, across_v} : HullEdge{from, to, across_v, across_u};
  }
  PLUMB_HD std::uint32_t loop_size(std::uint32_t) const { return 4; }
  PLUMB_HD std::uint32_t loop(std::uint32_t f, std::uint32_t k) const {
    const std::uint32_t across = f >> 1U, u = across == 2 ? 0 : across + 1, v = across == 0 ? 2 : across - 1;
    const std::uint32_t i = (f & 1U) != 0 ? k : 3 - k;  // 0: - -, 1: + -, 2: + +, 3: - +
    return ((f & 1U) << across) | ((i == 1 || i == 2 ? 1U : 0U) << u) | ((i >= 2 ? 1U : 0U) << v);
  }
  PLUMB_HD std::uint32_t support(const Vec& n) const {
    return (n.x > 0 ? 1U : 0U) | (n.y > 0 ? 2U : 0U) | (n.z > 0 ? 4U : 0U);
  }
};

/// That of an edge's two faces whose normal is closer to n.
template <class View>
PLUMB_HD std::uint32_t face_at_edge(const View& view, std::uint32_t e, const Vec& n) {
  const HullEdge edge = view.edge(e);
  return dot(view.normal(edge.right), n) > dot(view.normal(edge.left), n) + kTie ? edge.right : edge.left;
}

/// At the vertex furthest along n, the face closest to it at the edge that drops least: where the next touch would be.
template <class View>
PLUMB_HD std::uint32_t face_at_support(const View& view, const Vec& n) {
  const std::uint32_t vertex = view.support(n);
  std::uint32_t best = 0;
  Real least = kHuge;
  for (std::uint32_t e = 0; e < view.edge_count(); ++e) {
    const HullEdge edge = view.edge(e);
    if (edge.from != vertex && edge.to != vertex) continue;
    const Vec along = view.vertex(edge.to) - view.vertex(edge.from);
    if (const Real slope = abs(dot(n, along)) / length(along); slope < least - kTie) {
      least = slope;
      best = face_at_edge(view, e, n);
    }
  }
  return best;
}

/// Names an edge by its ends, whichever face it is seen from, in the 14 bits of a feature. Unique for up to 128
/// corners; beyond, names are spread so that two edges of one contact hardly share one.
PLUMB_HD constexpr std::uint32_t edge_between(std::uint32_t v, std::uint32_t w) {
  const std::uint32_t low = min(v, w), high = max(v, w);
  return high < 128U ? (low << 7U) + high : (low * 0x9e3779b1U + high * 0x85ebca6bU) >> 18U;
}

}  // namespace plumb::impulse
