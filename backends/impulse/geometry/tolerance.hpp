// The tolerances of the narrow phase. All are ratios: a scene of millimetres behaves as one of kilometres.
#pragma once

#include "math/real.hpp"

namespace plumb::impulse {

/// Of the sizes that enter a separation: what rounding can do to it. Axes whose separations differ by less are tied,
/// and the one that comes first (faces of A, faces of B, edge pairs) wins, so that the choice does not flicker.
constexpr Real kTie = Real(32) * kEpsilon;
/// Sine of the angle between two edges below which they are parallel and span no axis.
constexpr Real kParallel = Real(64) * kEpsilon;
/// Of a face's width: a corner that lies no further outside still counts as inside, so that equal boxes on top of each
/// other touch at the corners of one of them, however they tremble.
constexpr Real kClipSlack = Real(1e-3);
/// Angle below which two faces are level: which of their points is the deepest does not matter.
constexpr Real kLevel = Real(1e-4);
/// Angle by which a body may have to tip onto a point for it to count half as much as one that touches already.
constexpr Real kTip = Real(0.003);
/// Cosine of the angle to a face's normal below which an edge axis touches in a single point, above which the rest of
/// the faces is so close that it belongs to the contact.
constexpr Real kNearFace = Real(0.99);

}  // namespace plumb::impulse
