// A shape's description with the arrays that it points to.
#pragma once

#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::fuzz {

/// What a shape may be made of, with the arrays that it is made of.
struct ShapeArrays {
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  std::vector<double> vertices, heights;
  std::vector<std::uint32_t> indices, triangle_materials;
  std::vector<PlumbCompoundChild> children;
  std::vector<PlumbMaterial> materials;

  const PlumbShapeDesc* pointing() {
    desc.vertices = vertices.data();
    desc.indices = indices.data();
    desc.heights = heights.data();
    desc.children = children.data();
    desc.materials = materials.data();
    desc.triangle_materials = triangle_materials.data();
    return &desc;
  }
};

}  // namespace plumb::fuzz
