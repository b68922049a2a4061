// Where two convex shapes touch, as points: the corners of what their nearest features have in common.
#pragma once

#include <vector>

#include "referee/penetration.hpp"

namespace plumb::referee {

struct PatchPoint {
  Vec3 point;   ///< world, half way between the two surfaces
  Vec3 normal;  ///< unit, from a to b
  double gap;   ///< m; below 0 they overlap
};

/// The pair's normal is penetration()'s. The corners of each shape within `flat` of its furthest along it are its
/// feature there, a point, an edge or a face; the corners of the common part of both features carry whatever force the
/// common part can. Of compounds all pairs of children. Empty where the shapes are further apart than `reach`. m.
/// Throws plumb::Error (PLUMB_E_UNSUPPORTED) for planes, cylinders, meshes and height fields.
[[nodiscard]] std::vector<PatchPoint> contact_patch(const Shape& a, const Pose& pose_a, const Shape& b,
                                                    const Pose& pose_b, double flat, double reach);

/// Whether contact_patch can do it.
[[nodiscard]] bool has_patches(const Shape& shape);

}  // namespace plumb::referee
