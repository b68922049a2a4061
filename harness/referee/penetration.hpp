// How far two posed shapes overlap, or how far apart they are: the referee's geometry, which belongs to no engine.
#pragma once

#include "referee/shape.hpp"

namespace plumb::referee {

/// depth: the shortest translation that separates the shapes (m); negative: their distance.
struct Penetration {
  double depth;
  Vec3 normal;  ///< unit, from a to b: moving b along it by depth separates them
  Vec3 point;   ///< world, m: half way between the deepest (nearest) points of the two surfaces
};

enum class Apart {
  exact,       ///< the distance of shapes that are apart is exact
  lower_bound  ///< it is above 0 and no larger than the distance, but quicker to find
};

/// By the pair of types:
///  - spheres, capsules: closed forms on points and segments (a sphere against anything convex: its centre);
///  - boxes and hulls: every face and edge-pair direction (separating axes, Gauss map: Gregorius 2013) for the depth,
///    GJK (Gilbert, Johnson, Keerthi 1988) for the distance;
///  - cylinders: GJK, and an expanding polytope (van den Bergen 2001) whose depth is within 1e-9 of the size;
///  - a plane: the support point of the other;
///  - a mesh or height field against a convex shape: triangle by triangle, the deepest counts. A triangle lets go along
///    its front, the other shape's faces and edge pairs, but not through its back, nor over an edge further than the
///    surface turns away there: flat ground answers as a plane, however it is cut. Where several are cut and the whole
///    lets go sooner along one of their directions or of the shape's faces, that way counts. What does not cut the
///    surface is apart, a body that has passed through it entirely, too;
///  - compounds: the deepest pair of children.
/// Pairs in which neither is convex (after taking compounds apart), and plane against plane, never touch: depth
/// -infinity.
[[nodiscard]] Penetration penetration(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                      Apart apart = Apart::exact);

}  // namespace plumb::referee
