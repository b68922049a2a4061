// What the host finds out about a triangle mesh when it is made: which corners are one place, which triangles have an
// area, and who is whose neighbour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exec/executor.hpp"
#include "geometry/surface.hpp"
#include "plumb/types.h"

namespace plumb::impulse {

inline bool same_place(const PlumbVec3& a, const PlumbVec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Where a mesh's corners are.
struct MeshPlaces {
  PlumbVec3 centre;  ///< of the mesh's box; corners are relative to it
  Vec half;          ///< extents of the box
  Real reach;        ///< of the farthest corner from the centre
  std::vector<Vec> corners;
  bool joined;  ///< vertices of one corner are at one place
};
/// corner_of: by vertex; corners are numbered by their first ones.
[[nodiscard]] MeshPlaces place_corners(std::span<const PlumbVec3> vertices, std::span<const std::uint32_t> corner_of);

/// Empty where the triangle has no area.
[[nodiscard]] Box box_of(const MeshTriangle& triangle, const Vec* corners);

struct MeshTopology {
  std::vector<std::uint32_t> corner_of;  ///< by vertex
  MeshPlaces places;
  std::vector<MeshTriangle> triangles;
  std::vector<std::uint32_t> first_neighbour, neighbours;
  std::vector<Box> boxes;  ///< by triangle
  bool closed;             ///< every edge has two triangles at least

  /// indices: 3 a triangle, each below the number of vertices. Sorts on the executor's threads, or its device.
  MeshTopology(Executor& executor, std::span<const PlumbVec3> vertices, std::span<const std::uint32_t> indices);

 private:
  void find_neighbours(Executor& executor);
};

}  // namespace plumb::impulse
