// Collision shapes: from a descriptor to what Box3D makes its own shapes of. A body gets shapes of its own from these.
#pragma once

#include <memory>
#include <vector>

#include "box3d_math.hpp"

namespace plumb::box3d {

struct HullFree {
  void operator()(b3HullData* hull) const { b3DestroyHull(hull); }
};
struct MeshFree {
  void operator()(b3MeshData* mesh) const { b3DestroyMesh(mesh); }
};
using Hull = std::unique_ptr<b3HullData, HullFree>;
using Mesh = std::unique_ptr<b3MeshData, MeshFree>;

struct Shape {
  struct Child {
    const Shape* shape;
    PlumbPose pose;
    bool has_material;
    PlumbMaterial material;
  };

  PlumbShapeType type = PLUMB_SPHERE;
  float radius = 0, half_height = 0;     ///< of a sphere or a capsule
  Hull hull;                             ///< of all with faces; of a plane, a large box below it
  Mesh mesh;                             ///< of meshes and height fields; Box3D's shapes point to it
  std::vector<std::uint32_t> triangles;  ///< the host's number of each of the mesh's triangles
  std::vector<PlumbMaterial> materials;  ///< of triangles, after the body's, which is 0 in the mesh; none: all are that
  std::vector<Child> children;

  /// A capsule that Box3D would find too short is a sphere.
  [[nodiscard]] bool is_sphere() const;
};

/// children: of a compound, in their order; they outlive it. Throws Error for what Box3D cannot hold.
[[nodiscard]] std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::vector<const Shape*> children,
                                                int cylinder_sides);

/// mesh.cpp: fills mesh and triangles.
void make_mesh(Shape& shape, const PlumbShapeDesc& desc);
void make_height_field(Shape& shape, const PlumbShapeDesc& desc);

/// A convex shape at a pose: what Box3D's functions of distance and collision take.
struct Convex {
  enum class Kind { sphere, capsule, hull };  ///< in the order of Box3D's functions of pairs
  Kind kind = Kind::sphere;
  b3Sphere sphere{};
  b3Capsule capsule{};
  const b3HullData* hull = nullptr;

  /// Lives as long as the convex shape.
  [[nodiscard]] b3ShapeProxy proxy() const;
};
/// In the shape's own frame.
[[nodiscard]] Convex convex_of(const Shape& shape);

}  // namespace plumb::box3d
