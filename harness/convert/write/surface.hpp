// Shapes that files describe by their triangles.
#pragma once

#include <string>

#include "scene/model.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// Whether a shape is a hull, a mesh or a height field.
[[nodiscard]] inline bool has_surface(PlumbShapeType type) {
  return type == PLUMB_CONVEX_HULL || type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD;
}

/// Of a hull its faces; a height field as the referee cuts it. In the shape's own frame.
[[nodiscard]] Model surface_of(const Scene& scene, std::size_t shape);

/// A text in OBJ, which URDF and SDF files name.
[[nodiscard]] std::string obj_of(const Model& surface);

}  // namespace plumb::harness
