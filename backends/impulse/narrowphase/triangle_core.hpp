// One triangle of a surface and a convex shape, as distance.hpp asks about two shapes.
#pragma once

#include "geometry/surface.hpp"
#include "narrowphase/core.hpp"

namespace plumb::impulse {

/// Seen from the triangle's middle, the axes those of the surface.
template <class N>
struct TrianglePair {
  using Number = N;

  Vec3<N> corners[3];
  N triangle_reach;  ///< of the ball about the middle that holds the triangle
  Shape b;
  Mat33<N> turn;  ///< of B's axes
  Vec3<N> shift;  ///< to B's origin
  Hulls hulls;
  Vec3<N> middle;  ///< in the surface's frame

  /// other: the surface as A, and the shape.
  PLUMB_HD TrianglePair(const Triangle& triangle, const PlacedPair<N>& other)
      : triangle_reach(0), b(other.b), turn(other.turn), hulls(other.hulls) {
    for (int k = 0; k < 3; ++k) corners[k] = to_numbers<N>(triangle.at[k]);
    middle = (N(1) / 3) * (corners[0] + corners[1] + corners[2]);
    N square = 0;
    for (int k = 0; k < 3; ++k) {
      corners[k] -= middle;
      square = max(square, dot(corners[k], corners[k]));
    }
    triangle_reach = sqrt(square);
    shift = other.shift - middle;
  }

  PLUMB_HD Vec3<N> support(const Vec3<N>& n, Vec3<N>& on_a) const {
    const N s[3] = {dot(n, corners[0]), dot(n, corners[1]), dot(n, corners[2])};
    on_a = s[0] >= s[1] ? (s[0] >= s[2] ? corners[0] : corners[2]) : (s[1] >= s[2] ? corners[1] : corners[2]);
    return on_a - (turn * core_support(b, hulls, multiply_transposed(turn, -n)) + shift);
  }
  PLUMB_HD N radius_a() const { return 0; }
  PLUMB_HD N radius_b() const { return static_cast<N>(core_radius(b)); }
  PLUMB_HD N radii() const { return radius_b(); }
  PLUMB_HD N reach() const { return triangle_reach + static_cast<N>(b.reach); }
};

}  // namespace plumb::impulse
