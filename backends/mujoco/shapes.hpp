// Collision shapes: from a descriptor to the geoms of a model's text, and to what rays ask beside MuJoCo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mujoco_math.hpp"
#include "plumb/backend/convex_hull.hpp"

namespace plumb::mujoco {

struct Shape {
  struct Child {
    const Shape* shape;
    PlumbPose pose;
    bool has_material;
    PlumbMaterial material;
  };
  /// Of a height field: as MuJoCo holds it, the last row first, 0 the lowest and 1 the highest.
  struct Field {
    std::uint32_t rows, columns;
    double half_x, half_z, lowest, span;
    std::vector<float> heights;
  };

  PlumbShape handle = 0;
  PlumbShapeType type = PLUMB_SPHERE;
  double radius = 0, half_height = 0;
  PlumbVec3 half_extents{};
  backend::ConvexHull hull;  ///< of a convex hull
  Field field{};
  std::vector<Child> children;
};

/// children: of a compound, in their order; they outlive it.
[[nodiscard]] std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, PlumbShape handle,
                                                std::vector<const Shape*> children);

/// The name of what a model keeps once for all geoms of the shape.
[[nodiscard]] std::string asset_name(const Shape& shape);

/// From the shape's frame to MuJoCo's of the same geom.
[[nodiscard]] PlumbPose geom_frame(const Shape& shape);

/// Of the surface at a point of it, in the shape's frame; not of compounds.
[[nodiscard]] PlumbVec3 normal_at(const Shape& shape, const PlumbVec3& point);

/// MuJoCo's height fields are solid, with walls and a floor, which ours have not.
[[nodiscard]] bool is_on_surface(const Shape& shape, const PlumbVec3& point);

}  // namespace plumb::mujoco
