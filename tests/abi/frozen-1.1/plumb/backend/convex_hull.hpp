// The convex hull of points in space: triangles for integration, merged planar polygons for engines that want faces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// A planar face: its corners counter-clockwise seen from outside, at least 3.
struct HullFace {
  std::vector<std::uint32_t> loop;  ///< into ConvexHull::vertices
  PlumbVec3 normal;                 ///< unit, outward
  double offset;                    ///< m; every vertex p of its triangles has dot(normal, p) <= offset, one equals it
};

struct ConvexHull {
  std::vector<PlumbVec3> vertices;     ///< corners of triangles: a subset of the points, in their order
  std::vector<std::uint32_t> sources;  ///< index among the points of each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< a closed surface, counter-clockwise seen from outside
  /// The same surface with triangles merged that lie in one plane within merge_tolerance. A vertex that is no corner of
  /// any merged face (it lies inside a face or on a straight edge) is in no loop.
  std::vector<HullFace> faces;
  double extent;  ///< m: longest side of the points' bounding box
};

/// Of the extent: points within it of one plane are flat, and not a hull.
inline constexpr double hull_flat_tolerance = 1e-6;
/// Of the extent: triangles whose corners lie within it of a common plane are one face. Points that were rounded to
/// float32 still give whole faces.
inline constexpr double hull_merge_tolerance = 1e-6;

/// Throws Error (PLUMB_E_INVALID_ARGUMENT) when there are fewer than 4 points, one is not finite, or all lie in a
/// plane. Some thousand points take milliseconds.
[[nodiscard]] ConvexHull convex_hull(std::span<const PlumbVec3> points);

/// Likewise of the vertices of a shape descriptor.
[[nodiscard]] ConvexHull convex_hull(const PlumbShapeDesc& desc);

}  // namespace plumb::backend
