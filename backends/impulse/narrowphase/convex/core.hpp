// Convex shapes as a core, of which one asks for its furthest point in a direction, and a radius about it: a sphere is
// a point and a radius, a capsule a segment and a radius, boxes and hulls have none.
#pragma once

#include "geometry/shape.hpp"
#include "math/mat33.hpp"

namespace plumb::impulse {

// Not to Real and back to double in one function: gcc 12 forgets to round two such numbers that lie side by side.
template <class N, class M>
PLUMB_HD constexpr Vec3<N> to_numbers(const Vec3<M>& v) {
  return {static_cast<N>(v.x), static_cast<N>(v.y), static_cast<N>(v.z)};
}
template <class N, class M>
PLUMB_HD constexpr Quat4<N> to_numbers(const Quat4<M>& q) {
  return {static_cast<N>(q.x), static_cast<N>(q.y), static_cast<N>(q.z), static_cast<N>(q.w)};
}

PLUMB_HD inline Real core_radius(const Shape& shape) {
  switch (shape.type) {
    case ShapeType::kSphere:
    case ShapeType::kCapsule: return shape.size.x;
    default: return 0;
  }
}

/// The core's furthest point along n, in the shape's frame.
template <class N>
PLUMB_HD Vec3<N> core_support(const Shape& shape, const Hulls& hulls, const Vec3<N>& n) {
  const Vec3<N> size = to_numbers<N>(shape.size);
  switch (shape.type) {
    case ShapeType::kSphere: return {0, 0, 0};
    case ShapeType::kCapsule: return {0, n.y > 0 ? size.y : -size.y, 0};
    case ShapeType::kBox: return {n.x > 0 ? size.x : -size.x, n.y > 0 ? size.y : -size.y, n.z > 0 ? size.z : -size.z};
    case ShapeType::kHull: {
      const HullRange& hull = hulls.ranges[shape.hull];
      const Vec* vertices = hulls.vertices + hull.first_vertex;
      Vec3<N> best = to_numbers<N>(vertices[0]);
      N most = dot(n, best);
      for (std::uint32_t v = 1; v < hull.vertex_count; ++v) {
        const Vec3<N> vertex = to_numbers<N>(vertices[v]);
        const N here = dot(n, vertex);
        if (!(here > most)) continue;
        most = here;
        best = vertex;
      }
      return best;
    }
    case ShapeType::kCylinder: {
      const N across = sqrt(n.x * n.x + n.z * n.z), y = n.y > 0 ? size.y : -size.y;
      if (!(across > 0)) return {0, y, 0};
      return {size.x / across * n.x, y, size.x / across * n.z};
    }
    default: return {0, 0, 0};  // planes and surfaces have no core
  }
}

/// Two shapes, seen from the frame of A.
template <class N>
struct PlacedPair {
  using Number = N;

  Shape a, b;
  Mat33<N> turn;  ///< of B's axes
  Vec3<N> shift;  ///< to B's origin
  Hulls hulls;

  /// The furthest point of A - B along n, and the point of A that it comes from.
  PLUMB_HD Vec3<N> support(const Vec3<N>& n, Vec3<N>& on_a) const {
    on_a = core_support(a, hulls, n);
    return on_a - (turn * core_support(b, hulls, multiply_transposed(turn, -n)) + shift);
  }
  PLUMB_HD N radius_a() const { return static_cast<N>(core_radius(a)); }
  PLUMB_HD N radius_b() const { return static_cast<N>(core_radius(b)); }
  PLUMB_HD N radii() const { return radius_a() + radius_b(); }
  /// No further apart are the origins of shapes that touch.
  PLUMB_HD N reach() const { return static_cast<N>(a.reach) + static_cast<N>(b.reach); }
};

}  // namespace plumb::impulse
