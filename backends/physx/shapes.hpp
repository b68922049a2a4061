// Collision shapes: PhysX's geometries, and beside them what tells children and triangles apart.
#pragma once

#include <extensions/PxCustomGeometryExt.h>

#include <memory>
#include <span>
#include <vector>

#include "physx_math.hpp"
#include "plumb/backend/triangle_materials.hpp"

namespace plumb::px {

/// One geometry of PhysX and where it is in the shape's frame.
struct Piece {
  PxGeometryHolder geometry;
  PxTransform at{PxIdentity};
  std::uint32_t child = 0;
  bool has_material = false;
  PlumbMaterial material{};  ///< where it has one of its own

  [[nodiscard]] bool is(PxGeometryType::Enum type) const { return geometry.getType() == type; }
};

struct Shape {
  Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  ~Shape();

  PlumbShapeType type = PLUMB_SPHERE;
  std::vector<Piece> pieces;       ///< of a compound its children, else one
  PxRefCounted* cooked = nullptr;  ///< hull, mesh or height field
  std::unique_ptr<PxCustomGeometryExt::CylinderCallbacks> cylinder;
  std::vector<PlumbMaterial> materials;  ///< of triangles, by their number in the geometry less one
  backend::TriangleMaterials triangles;  ///< of meshes and height fields

  void swap(Shape& other);
  /// The host's number of a triangle of a mesh that PhysX tells; else 0.
  [[nodiscard]] std::uint32_t triangle_of(PxU32 face) const;
};

/// children: of a compound, in their order. Throws Error for what PhysX cannot hold.
[[nodiscard]] std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::span<const Shape* const> children);

/// cooked.cpp: hulls, meshes and height fields.
void make_hull(const PlumbShapeDesc& desc, Shape& shape);
void make_mesh(const PlumbShapeDesc& desc, Shape& shape);
void make_height_field(const PlumbShapeDesc& desc, Shape& shape);

}  // namespace plumb::px
