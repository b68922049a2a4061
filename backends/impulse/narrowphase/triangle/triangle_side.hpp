// A triangle of a surface, and the question that keeps bodies from catching at edges within it: whether the surface,
// and not only the triangle, bulges towards a direction at the corner or edge that is foremost there. Where it does
// not, the neighbours are what is touched, or the triangle's own plane.
#pragma once

#include "geometry/surface.hpp"
#include "geometry/tolerance.hpp"

namespace plumb::impulse {

namespace surface {

/// Sine of an angle below which a direction counts as along a neighbour's plane.
constexpr Real kAlongPlane = Real(2e-3);
/// And up to which it is the neighbour that touches, although it rises: along a direction so close to its normal.
constexpr Real kNearlyAlong = Real(0.1);

enum class Bulge {
  kOut,     ///< some part of the surface near by reaches further along the direction
  kShared,  ///< a neighbour's edge or face is as far
  kStrict   ///< this corner or edge is foremost by itself
};
/// rise: as found below.
PLUMB_HD constexpr Bulge bulge_of(Real rise) {
  return rise > kNearlyAlong ? Bulge::kOut : rise >= -kAlongPlane ? Bulge::kShared : Bulge::kStrict;
}

struct RingTest {
  Vec from, direction;
  Real most = -1;  ///< sine of the angle by which a neighbour rises

  PLUMB_HD void add(const Vec& neighbour) {
    const Vec along = neighbour - from;
    most = max(most, dot(direction, along) / length(along));
  }
};

/// Sine of the angle by which the steepest neighbour of a corner rises along a direction.
template <class Surface>
PLUMB_HD Real rise_at_corner(const Surface& surface, std::uint32_t corner, const Vec& direction) {
  RingTest test{surface.corner(corner), direction};
  const auto look = [&](std::uint32_t neighbour) {
    test.add(surface.corner(neighbour));
    return test.most <= kNearlyAlong;
  };
  surface.around(corner, look);
  return test.most;
}

/// The same at the edge from corner k of triangle t, for a direction across it.
template <class Surface>
PLUMB_HD Real rise_at_edge(const Surface& surface, std::uint32_t t, const Triangle& triangle, int k,
                           const Vec& direction) {
  RingTest test{triangle.at[k], direction};
  test.add(triangle.at[k == 0 ? 2 : k - 1]);
  if (const std::uint32_t far = surface.across(t, k); far != kNoCorner) test.add(surface.corner(far));
  return test.most;
}

/// The side of a triangle that pushes: its plane, and the corners counter-clockwise seen from there.
struct TriangleSide {
  Triangle triangle;
  Vec normal;
  Real offset;
  bool reversed;

  PLUMB_HD explicit TriangleSide(const Triangle& t) : triangle(t), reversed(false) {
    const Vec &a = t.at[0], &b = t.at[1], &c = t.at[2];
    normal = normalized_or(cross(b - a, c - a), {0, 1, 0});
    offset = dot(normal, (Real(1) / 3) * (a + b + c));
  }
  PLUMB_HD void turn_over() {
    reversed = true;
    normal = -normal;
    offset = -offset;
  }
  /// Outward across the edge from corner k, in the plane; as long as the edge.
  [[nodiscard]] PLUMB_HD Vec outward(int k) const {
    const Vec out = cross(triangle.at[k == 2 ? 0 : k + 1] - triangle.at[k], normal);
    return reversed ? -out : out;
  }
  [[nodiscard]] PLUMB_HD Real height(const Vec& p) const { return dot(normal, p) - offset; }
  /// Whether p lies over the triangle, or no more than `slack` beside it.
  [[nodiscard]] PLUMB_HD bool is_over(const Vec& p, Real slack) const {
    for (int k = 0; k < 3; ++k) {
      const Vec out = outward(k);
      if (dot(out, p - triangle.at[k]) > slack * length(out)) return false;
    }
    return true;
  }
};

/// The outside pushes, unless what touches lies clearly behind: three quarters of its extent from low to high along the
/// normal. Of a closed mesh the inside pushes only what is over the triangle: false for all other, which stands on
/// another face, or its rim, and must not be held back by the wall below it.
template <class Surface>
PLUMB_HD bool choose_side(const Surface& surface, const Vec& centre, Real low, Real high, TriangleSide& side) {
  if (!(3 * high < -low)) return true;
  if (surface.is_closed() && !side.is_over(centre, kAlongPlane * (high - low))) return false;
  side.turn_over();
  return true;
}

}  // namespace surface

}  // namespace plumb::impulse
