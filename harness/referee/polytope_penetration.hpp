// Separating axes of two polytopes. Inner part of penetration.hpp.
#pragma once

#include "referee/penetration.hpp"

namespace plumb::referee {

/// Depth of two polytopes in one frame, b placed by pose_b, over all face normals and edge pairs; when they are apart
/// the largest separation over these axes, a lower bound of their distance. Two solids use the Gauss map to find the
/// edge pairs that count (Gregorius 2013, "The Separating Axis Test between Convex Polyhedra"); a point, segment or
/// triangle tries them all. Of two flat ones (no solid) the depth means nothing.
[[nodiscard]] Penetration polytope_penetration(const Polytope& a, const Polytope& b, const Pose& pose_b);

/// The 15 axes of two boxes (Gottschalk, Lin, Manocha 1996). Same answer, faster.
[[nodiscard]] Penetration box_penetration(const Vec3& half_a, const Vec3& half_b, const Pose& pose_b);

}  // namespace plumb::referee
