// Collision shapes: Jolt's, and beside it what tells children and triangles apart.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "jolt_math.hpp"
#include "plumb/backend/triangle_materials.hpp"

namespace plumb::jolt {

struct Shape {
  PlumbShapeType type = PLUMB_SPHERE;
  JPH::RefConst<JPH::Shape> jolt;
  std::vector<PlumbMaterial> children;   ///< of a compound, where one of them has a material of its own
  std::vector<bool> has_own;             ///< which of them has
  backend::TriangleMaterials triangles;  ///< of meshes and height fields

  [[nodiscard]] bool has_materials() const { return !children.empty() || !triangles.empty(); }
  /// Of a part of the shape; null: the body's.
  [[nodiscard]] const PlumbMaterial* material_of(JPH::SubShapeID part) const;
  /// The child of a compound, or the host's number of a triangle of a mesh; else 0.
  [[nodiscard]] std::uint32_t child_of(JPH::SubShapeID part) const;
};

/// children: of a compound, in their order. Throws Error for what Jolt cannot hold.
[[nodiscard]] std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::span<const Shape* const> children,
                                                double convex_radius);

/// mesh.cpp
[[nodiscard]] JPH::Shape::ShapeResult make_mesh(const PlumbShapeDesc& desc);
[[nodiscard]] JPH::Shape::ShapeResult make_height_field(const PlumbShapeDesc& desc);

/// Where a shape's centre of mass is when its frame is at a pose: what Jolt's queries take. offset: taken off first.
[[nodiscard]] JPH::Mat44 centre_transform(const JPH::Shape& shape, const PlumbPose& pose, const PlumbVec3& offset);

}  // namespace plumb::jolt
