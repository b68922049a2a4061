// Distances of convex shapes in double by brute force over all their vertices, edges and faces, and by clipping: shares
// nothing with the engine but the shapes.
#pragma once

#include <algorithm>

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse::reference {

/// The core of any shape as vertices, edges and faces: a ball's is one vertex, a capsule's one edge.
struct Features {
  struct Face {
    V normal;
    std::vector<V> loop;
  };
  std::vector<V> vertices;
  std::vector<std::pair<V, V>> edges;
  std::vector<Face> faces;
  double radius = 0;

  void move(const V& by) {
    for (V& v : vertices) v += by;
    for (auto& [p, q] : edges) {
      p += by;
      q += by;
    }
    for (Face& face : faces)
      for (V& v : face.loop) v += by;
  }
};

template <class View>
void add_features(const View& view, const Quat4<double>& q, Features& out) {
  const auto at = [&](std::uint32_t v) { return rotate(q, to_double(view.vertex(v))); };
  for (std::uint32_t v = 0; v < view.vertex_count(); ++v) out.vertices.push_back(at(v));
  for (std::uint32_t e = 0; e < view.edge_count(); ++e)
    out.edges.emplace_back(at(view.edge(e).from), at(view.edge(e).to));
  for (std::uint32_t f = 0; f < view.face_count(); ++f) {
    Features::Face face;
    for (std::uint32_t k = 0; k < view.loop_size(f); ++k) face.loop.push_back(at(view.loop(f, k)));
    face.normal = unit(cross(face.loop[1] - face.loop[0], face.loop[2] - face.loop[0]));  // the stored one is a float
    out.faces.push_back(face);
  }
}

inline Features features_of(const Shape& shape, const Hulls& hulls, const Quat4<double>& q, const V& place) {
  Features out;
  switch (shape.type) {
    case ShapeType::kSphere:
      out.radius = static_cast<double>(shape.size.x);
      out.vertices = {{0, 0, 0}};
      break;
    case ShapeType::kCapsule: {
      out.radius = static_cast<double>(shape.size.x);
      const V end = rotate(q, V{0, static_cast<double>(shape.size.y), 0});
      out.vertices = {end, -end};
      out.edges = {{-end, end}};
      break;
    }
    case ShapeType::kBox: add_features(BoxView{shape.size}, q, out); break;
    case ShapeType::kHull: add_features(HullView(hulls, shape.hull), q, out); break;
    default: break;  // has other features
  }
  out.move(place);
  return out;
}

inline double distance(const V& p, const std::pair<V, V>& edge) {
  const V e = edge.second - edge.first;
  const double t = std::clamp(dot(p - edge.first, e) / std::max(dot(e, e), 1e-300), 0.0, 1.0);
  return length(edge.first + t * e - p);
}
/// Between the insides of two segments; infinite where the closest points are ends.
inline double distance(const std::pair<V, V>& a, const std::pair<V, V>& b) {
  const V d = a.second - a.first, e = b.second - b.first, n = cross(d, e), w = b.first - a.first;
  const double nn = dot(n, n);
  if (nn <= 1e-24 * dot(d, d) * dot(e, e)) return std::numeric_limits<double>::infinity();
  const double s = dot(cross(w, e), n) / nn, r = dot(cross(w, d), n) / nn;
  if (s < 0 || s > 1 || r < 0 || r > 1) return std::numeric_limits<double>::infinity();
  return std::abs(dot(w, n)) / std::sqrt(nn);
}
/// From outside of the face, over it; else infinite.
inline double distance(const V& p, const Features::Face& face) {
  for (std::size_t k = 0; k < face.loop.size(); ++k) {
    const V &from = face.loop[k], &to = face.loop[(k + 1) % face.loop.size()];
    if (dot(cross(to - from, p - from), face.normal) < 0) return std::numeric_limits<double>::infinity();
  }
  const double height = dot(face.normal, p - face.loop[0]);
  return height >= 0 ? height : std::numeric_limits<double>::infinity();
}

/// Whether a point or segment enters the polyhedron.
inline bool enters(const std::pair<V, V>& segment, const Features& solid) {
  double first = 0, last = 1;
  const V along = segment.second - segment.first;
  for (const Features::Face& face : solid.faces) {
    const double at = dot(face.normal, segment.first - face.loop[0]), speed = dot(face.normal, along);
    if (speed == 0 && at > 0) return false;
    if (speed > 0) last = std::min(last, -at / speed);
    if (speed < 0) first = std::max(first, -at / speed);
  }
  return first <= last;
}
inline bool cores_overlap(const Features& a, const Features& b) {
  for (const auto* one : {&a, &b}) {
    const Features& other = one == &a ? b : a;
    if (other.faces.empty()) continue;
    for (const V& v : one->vertices)
      if (enters({v, v}, other)) return true;
    for (const auto& edge : one->edges)
      if (enters(edge, other)) return true;
  }
  return false;
}

/// Of the shapes, radii off; of cores that overlap it is minus the radii.
inline double distance(const Features& a, const Features& b) {
  double best = std::numeric_limits<double>::infinity();
  if (cores_overlap(a, b)) best = 0;
  for (const V& v : a.vertices) {
    for (const V& w : b.vertices) best = std::min(best, length(v - w));
    for (const auto& edge : b.edges) best = std::min(best, distance(v, edge));
    for (const auto& face : b.faces) best = std::min(best, distance(v, face));
  }
  for (const V& w : b.vertices) {
    for (const auto& edge : a.edges) best = std::min(best, distance(w, edge));
    for (const auto& face : a.faces) best = std::min(best, distance(w, face));
  }
  for (const auto& edge : a.edges)
    for (const auto& other : b.edges) best = std::min(best, distance(edge, other));
  return best - a.radius - b.radius;
}

/// The core's furthest point along n, and the radius.
inline double high(const Features& a, const V& n) {
  double most = -std::numeric_limits<double>::infinity();
  for (const V& v : a.vertices) most = std::max(most, dot(n, v));
  return most + a.radius * length(n);
}

/// Any of the four types; sizes of about `scale`.
inline Shape random_shape(Dice& dice, HullPool& pool, double scale) {
  const auto size = [&] { return static_cast<Real>(scale * dice.uniform(0.3, 1)); };
  switch (dice.below(4)) {
    case 0: {
      const Real r = size();
      return {ShapeType::kSphere, 0, {r, 0, 0}, r};
    }
    case 1: {
      const Real r = size(), half = dice.below(8) == 0 ? Real(0) : size();
      return {ShapeType::kCapsule, 0, {r, half, 0}, r + half};
    }
    case 2: return random_box(dice, scale);
    default: return random_hull(dice, pool, scale, 20);
  }
}

}  // namespace plumb::impulse::reference
