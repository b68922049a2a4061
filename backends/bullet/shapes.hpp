// Collision shapes: from a descriptor to Bullet's shape and the memory that it leans on.
#pragma once

#include <memory>
#include <vector>

#include "bullet_math.hpp"
#include "plumb/backend/triangle_materials.hpp"

namespace plumb::bullet {

/// What of the settings shapes are made with.
struct ShapeOptions {
  double margin;       ///< m, around convex shapes with edges
  bool hull_clipping;  ///< contact polygons of hulls by clipping instead of one point of GJK a step
};

/// Bullet numbers the triangles of a quantized tree with 21 bits.
constexpr std::uint32_t kQuantizedTriangles = 1u << 21;

struct Shape {
  struct Child {
    std::shared_ptr<const Shape> shape;
    btTransform pose;
    bool has_material;
    PlumbMaterial material;
  };

  PlumbShapeType type = PLUMB_SPHERE;
  std::unique_ptr<btCollisionShape> bullet;
  std::vector<btScalar> vertices;  ///< of a mesh, or of a hull as it was given
  std::vector<int> indices;
  std::unique_ptr<btStridingMeshInterface> mesh;
  std::unique_ptr<btOptimizedBvh> tree;  ///< of a mesh that was cooked; others have it in bullet
  std::vector<btScalar> heights;
  std::vector<Child> children;
  backend::TriangleMaterials materials;
  double inner_radius = 0;  ///< m, of a sphere that fits inside, about the origin of a convex shape; for swept spheres

  /// Whether parts of it may have another material than the body.
  [[nodiscard]] bool has_own_material() const;
};

/// find: the living shape of a handle. Throws Error for what Bullet's arithmetic cannot hold.
template <class Find>
std::vector<Shape::Child> children_of(const PlumbShapeDesc& desc, Find&& find) {
  std::vector<Shape::Child> children;
  for (std::uint32_t i = 0; i < desc.child_count; ++i) {
    const PlumbCompoundChild& child = desc.children[i];
    children.push_back(
        {find(child.shape), transform(child.pose, "position of a child"), child.has_material != 0, child.material});
  }
  return children;
}

std::shared_ptr<const Shape> make_shape(const PlumbShapeDesc& desc, std::vector<Shape::Child> children,
                                        const ShapeOptions& options);

/// The vertices and triangles of a mesh, and the view of them that Bullet reads.
void take_triangles(const PlumbShapeDesc& desc, Shape& shape);
void index_triangles(Shape& shape);

/// The arrays of a mesh as Bullet takes them; they must outlive what is made of it.
btIndexedMesh indexed_mesh(const std::vector<btScalar>& vertices, const std::vector<int>& indices);

/// The same shape placed in a frame that moved: Bullet wants a body's origin in its centre of mass and its axes along
/// the principal ones. offset: the body's frame seen from that frame.
std::unique_ptr<btCollisionShape> make_offset_shape(const Shape& shape, const btTransform& offset);

}  // namespace plumb::bullet
