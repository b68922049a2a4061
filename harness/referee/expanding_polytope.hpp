// Depth of two overlapping convex sets by their support functions. Inner part of penetration.hpp.
#pragma once

#include "referee/convex_distance.hpp"
#include "referee/penetration.hpp"

namespace plumb::referee {

/// Grows the convex hull of support points of the difference a - b where its surface is nearest to the origin, until
/// that surface is the difference's own (after van den Bergen 2001, "Proximity Queries and Penetration Depth
/// Computation on 3D Game Objects"). The hull starts from fixed directions and need not hold the origin, so touching
/// sets are no special case. The difference must have volume. depth is within 1e-10 of the size of the truth, or below
/// 0: a bound on how far the sets are apart.
[[nodiscard]] Penetration expanding_polytope(const ConvexView& a, const ConvexView& b);

}  // namespace plumb::referee
