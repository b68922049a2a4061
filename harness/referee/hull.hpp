// The convex hull of points, by Qhull (Barber, Dobkin, Huhdanpaa 1996): not by what backends are offered for it
// (plumb/backend/convex_hull.hpp), since a fault that judge and judged share is seen by nobody.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "referee/pose.hpp"

namespace plumb::referee {

struct Hull {
  /// A planar face: its corners counter-clockwise seen from outside.
  struct Face {
    std::vector<std::uint32_t> loop;  ///< into corners
    Vec3 normal;                      ///< unit, outward
  };
  std::vector<Vec3> corners;                            ///< a subset of the points, in their order
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< a closed surface, counter-clockwise seen from outside
  /// The same surface with what lies in one plane within 1e-6 of the extent merged, so that points that were rounded to
  /// float32 still make whole faces; its triangles where they cannot be merged.
  std::vector<Face> faces;
};

/// Throws plumb::Error (PLUMB_E_INVALID_ARGUMENT) for points that have no volume: fewer than 4, not finite, or thinner
/// than 1e-6 of their extent.
[[nodiscard]] Hull convex_hull(std::span<const Vec3> points);

}  // namespace plumb::referee
