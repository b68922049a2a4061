// One triangle of a surface and a convex shape, as distance.hpp asks about two shapes.
#pragma once

#include "geometry/surface.hpp"
#include "narrowphase/convex/core.hpp"

namespace plumb::impulse {

PLUMB_HD inline Triangle triangle_of(const Shape& surface, const Surfaces& surfaces, std::uint32_t t) {
  return surface.type == ShapeType::kMesh ? surfaces.meshes[surface.hull].triangle(t)
                                          : surfaces.fields[surface.hull].triangle(t);
}

template <class N>
PLUMB_HD Vec3<N> middle_of(const Triangle& triangle) {
  return (N(1) / 3) * (to_numbers<N>(triangle.at[0]) + to_numbers<N>(triangle.at[1]) + to_numbers<N>(triangle.at[2]));
}

/// Seen from a point near the triangle, the axes those of the surface.
template <class N>
struct TrianglePair {
  using Number = N;

  Vec3<N> corners[3];
  Shape b;
  Mat33<N> turn;  ///< of B's axes
  Vec3<N> shift;  ///< to B's origin
  Hulls hulls;

  /// other: the surface as A, and the shape. about: the point, in the surface's frame.
  PLUMB_HD TrianglePair(const Triangle& triangle, const PlacedPair<N>& other, const Vec3<N>& about)
      : b(other.b), turn(other.turn), shift(other.shift - about), hulls(other.hulls) {
    for (int k = 0; k < 3; ++k) corners[k] = to_numbers<N>(triangle.at[k]) - about;
  }

  PLUMB_HD Vec3<N> support(const Vec3<N>& n, Vec3<N>& on_a) const {
    const N s[3] = {dot(n, corners[0]), dot(n, corners[1]), dot(n, corners[2])};
    on_a = s[0] >= s[1] ? (s[0] >= s[2] ? corners[0] : corners[2]) : (s[1] >= s[2] ? corners[1] : corners[2]);
    return on_a - (turn * core_support(b, hulls, multiply_transposed(turn, -n)) + shift);
  }
  PLUMB_HD N radius_a() const { return 0; }
  PLUMB_HD N radius_b() const { return static_cast<N>(core_radius(b)); }
  PLUMB_HD N radii() const { return radius_b(); }
  PLUMB_HD N reach() const {
    N square = 0;
    for (const Vec3<N>& corner : corners) square = max(square, dot(corner, corner));
    return sqrt(square) + static_cast<N>(b.reach);
  }
};

}  // namespace plumb::impulse
