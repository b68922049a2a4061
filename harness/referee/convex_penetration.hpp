// Two convex shapes. Inner part of penetration.hpp.
#pragma once

#include "referee/penetration.hpp"

namespace plumb::referee {

/// In a's frame, b placed by pose_b. Both must be convex.
[[nodiscard]] Penetration convex_penetration(const Shape& a, const Shape& b, const Pose& pose_b, Apart apart);

/// A mesh or height field against a convex shape placed in its frame; the normal is from the mesh to the shape.
[[nodiscard]] Penetration mesh_penetration(const Shape& mesh, const Shape& convex, const Pose& pose_convex,
                                           Apart apart);

}  // namespace plumb::referee
