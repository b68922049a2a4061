// Closest points of points, segments and faces.
#pragma once

#include "geometry/tolerance.hpp"
#include "math/vec3.hpp"

namespace plumb::impulse {

/// The parameter in [0, 1] of the point of p + s d that is closest to `to`.
PLUMB_HD inline Real closest_on_segment(const Vec& p, const Vec& d, const Vec& to) {
  const Real square = length_squared(d);
  return square > 0 ? clamp(dot(to - p, d) / square, Real(0), Real(1)) : Real(0);
}

struct ClosestPair {
  Vec on_a, on_b;
  Real s, r;  ///< parameters in [0, 1]
};

/// Of the segments p + s d and q + r e (Ericson, Real-Time Collision Detection, 5.1.9). Of parallel segments, one of
/// the closest pairs.
PLUMB_HD inline ClosestPair closest_between(const Vec& p, const Vec& d, const Vec& q, const Vec& e) {
  const Vec w = p - q;
  const Real dd = length_squared(d), ee = length_squared(e), de = dot(d, e), dw = dot(d, w);
  const Real sine2 =
      length_squared(cross(d, e));  // dd ee - de de loses all digits where the segments are near parallel
  Real s = sine2 > kParallel * kParallel * dd * ee ? clamp((de * dot(e, w) - dw * ee) / sine2, Real(0), Real(1)) : 0;
  const Real r = closest_on_segment(q, e, p + s * d);
  s = closest_on_segment(p, d, q + r * e);
  return {p + s * d, q + r * e, s, r};
}

}  // namespace plumb::impulse
