// A turn of frame b seen from frame a as a swing after a twist (plumb/joints.h), and how fast both change: for rows
// that hold b's x axis within an elliptic cone about a's, and the twist about it within limits, or drive the three.
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

/// The swing of a turn: about which axis, square to a's x axis, and by which angle b's x axis has left it.
class Swing {
 public:
  Swing() = default;
  /// a: the axes of frame a in the world.
  PLUMB_HD Swing(const Mat& a, const Vec& x_of_b) {
    const Vec across = cross(a.x, x_of_b);
    const Real sine = length(across);
    angle_ = angle_of(sine, dot(a.x, x_of_b));
    axis_ = normalized_or(across, a.y);
    parallel_ = cross(x_of_b, axis_);
    y_ = dot(axis_, a.y);
    z_ = dot(axis_, a.z);
    // Along the meridian b's axis moves as fast as it turns, along the parallel by the sine.
    by_sine_ = angle_ > Real(0.01) ? angle_ / max(sine, Real(0.01)) : Real(1);
  }
  /// The length of the swing's vector, whose z counts `narrow` times: constant along a cone that is `narrow` times less
  /// wide about z than about y, where it is the half angle about y, rad.
  [[nodiscard]] PLUMB_HD TurnNumber in_cone(Real narrow) const {
    const Real stretch = sqrt(y_ * y_ + narrow * narrow * z_ * z_);
    const Real along = by_sine_ * (y_ * z_ * (narrow * narrow - Real(1)) / stretch);
    return {stretch * angle_, stretch * axis_ + along * parallel_};
  }
  /// The swing's vector along a's y or z, 1 or 2, rad.
  [[nodiscard]] PLUMB_HD TurnNumber about(int axis) const {
    const Real own = axis == 1 ? y_ : z_, other = axis == 1 ? -z_ : y_;
    return {own * angle_, own * axis_ + (by_sine_ * other) * parallel_};
  }

 private:
  Real angle_;
  Vec axis_;      ///< about which it is
  Vec parallel_;  ///< a turn about it moves b's x axis along the parallel
  Real y_, z_;    ///< the axis, in a's
  Real by_sine_;  ///< the angle by its sine
};

}  // namespace plumb::impulse
