// Shapes as triangles, to be drawn.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/json.hpp"

namespace plumb::harness {

struct DrawnMesh {
  std::vector<std::array<float, 3>> positions, normals;  ///< of vertices; m, unit, in the shape's frame
  std::vector<std::uint32_t> indices;                    ///< three a triangle, counter-clockwise seen from outside
};

/// Of one shape of a replay's header (record/trajectory_header.hpp) that is no compound; null: a body without a shape,
/// drawn as a small ball. Round shapes are cut into 24 segments; a plane is drawn as far as 50 m from its origin.
[[nodiscard]] DrawnMesh drawn_mesh(const Json& shape);

}  // namespace plumb::harness
