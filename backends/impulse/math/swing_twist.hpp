// A turn of frame b seen from frame a as a swing after a twist (plumb/joints.h), and how fast both change: for rows
// that hold b's x axis within an elliptic cone about a's, and the twist about it within limits.
#pragma once

#include "math/angle.hpp"

namespace plumb::impulse {

/// A number, and the direction along which a turn of b against a changes it: its rate is their product.
struct TurnNumber {
  Real value;
  Vec direction;
};

/// The angle about x that is left when the swing of a turn of b seen from a is taken back, rad; 0 where the x axes,
/// which are in world axes, are opposite.
PLUMB_HD inline TurnNumber twist_of(const Quat& turn, const Vec& x_of_a, const Vec& x_of_b) {
  const Real side = turn.w < 0 ? Real(-1) : Real(1);
  // A twist alone turns about both axes; beside a swing, about what lies between them, and the faster the further off.
  const Real share = Real(1) / max(Real(1) + dot(x_of_a, x_of_b), Real(0.01));
  return {2 * angle_of(side * turn.x, side * turn.w), share * (x_of_a + x_of_b)};
}

/// The length of the swing's vector, whose z counts `narrow` times: constant along a cone that is `narrow` times less
/// wide about z than about y, where it is the half angle about y, rad. a: the axes of frame a in the world.
PLUMB_HD inline TurnNumber swing_in_cone(const Mat& a, const Vec& x_of_b, Real narrow) {
  const Vec across = cross(a.x, x_of_b);
  const Real sine = length(across), angle = angle_of(sine, dot(a.x, x_of_b));
  const Vec about = normalized_or(across, a.y);
  const Real y = dot(about, a.y), z = dot(about, a.z);
  const Real stretch = sqrt(y * y + narrow * narrow * z * z);
  // Along the meridian b's axis moves as fast as it turns, along the parallel by the sine.
  const Real by_sine = angle > Real(0.01) ? angle / max(sine, Real(0.01)) : Real(1);
  const Real along = by_sine * (y * z * (narrow * narrow - Real(1)) / stretch);
  return {stretch * angle, stretch * about + along * cross(x_of_b, about)};
}

}  // namespace plumb::impulse
