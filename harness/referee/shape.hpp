// Shapes as the referee sees them: own copies of a descriptor's arrays, with support functions and bounds.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "plumb/physics_world.hpp"
#include "referee/pose.hpp"

namespace plumb::referee {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct Aabb {
  Vec3 low = Vec3::Constant(infinity);
  Vec3 high = Vec3::Constant(-infinity);

  void include(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void include(const Aabb& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  [[nodiscard]] bool overlaps(const Aabb& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// A convex polytope by corners, faces and edges; also a lone point, segment or triangle, which has no volume.
struct Polytope {
  struct Face {
    Vec3 normal;  ///< unit, outward
    double offset;
  };
  struct Edge {
    std::uint32_t from, to;
    Vec3 normal_left, normal_right;  ///< of the two faces that meet here; unset when not solid
  };
  std::vector<Vec3> corners;
  std::vector<Face> faces;  ///< of a triangle: its front and its back
  std::vector<Edge> edges;
  bool solid = false;
  Vec3 centre = Vec3::Zero();  ///< a point inside
  double radius = 0;           ///< all corners are within it of the centre

  /// Index of the corner furthest along a direction.
  [[nodiscard]] std::size_t support(const Vec3& direction) const;
};

class Shape;
using ShapePtr = std::shared_ptr<const Shape>;

class Shape {
 public:
  struct Child {
    ShapePtr shape;
    Pose pose;
  };
  using Triangle = std::array<Vec3, 3>;  ///< counter-clockwise seen from outside

  /// Copies the arrays. children: of a compound, the shapes of desc.children in their order. Throws plumb::Error
  /// (PLUMB_E_INVALID_ARGUMENT) for flat hulls and for compounds whose children are not given.
  static ShapePtr make(const PlumbShapeDesc& desc, std::span<const ShapePtr> children = {});

  [[nodiscard]] PlumbShapeType type() const { return type_; }
  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] double half_height() const { return half_height_; }
  [[nodiscard]] const Vec3& half_extents() const { return half_extents_; }
  [[nodiscard]] const std::vector<Child>& children() const { return children_; }
  /// Of a mesh or a height field; of a hull its surface. Each height field cell is cut along the diagonal from (column,
  /// row + 1) to (column + 1, row).
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Sphere, box, capsule, cylinder or hull.
  [[nodiscard]] bool convex() const { return type_ <= PLUMB_CONVEX_HULL; }
  /// Convex shapes but cylinders are a polytope (a sphere's is a point, a capsule's a segment) grown by rounding().
  [[nodiscard]] bool has_core() const { return convex() && type_ != PLUMB_CYLINDER; }
  [[nodiscard]] const Polytope& core() const { return core_; }
  [[nodiscard]] double rounding() const { return has_core() ? radius_ : 0; }

  /// The point furthest along a local direction (not 0) of a convex shape, rounding left out.
  [[nodiscard]] Vec3 core_support(const Vec3& direction) const;
  /// The same with the rounding.
  [[nodiscard]] Vec3 support(const Vec3& direction) const;

  /// Tight. A plane's is unbounded below it when it lies level, else unbounded on all sides.
  [[nodiscard]] Aabb bounds(const Pose& pose) const;
  /// Local bounds of each triangle, in the order of triangles().
  [[nodiscard]] const std::vector<Aabb>& triangle_bounds() const { return triangle_bounds_; }
  /// Of a mesh or a height field: for each triangle the unit normals of the triangles across its edges (corner i to
  /// corner i + 1, found by equal positions), zero where there is none or more than one.
  [[nodiscard]] const std::vector<std::array<Vec3, 3>>& neighbour_normals() const { return neighbour_normals_; }

 private:
  void make_box_core();
  void make_hull_core(const PlumbShapeDesc& desc);
  void make_mesh(const PlumbShapeDesc& desc);
  void make_height_field(const PlumbShapeDesc& desc);
  void find_neighbours();

  PlumbShapeType type_ = PLUMB_SPHERE;
  double radius_ = 0;
  double half_height_ = 0;
  Vec3 half_extents_ = Vec3::Zero();
  Polytope core_;
  std::vector<Triangle> triangles_;
  std::vector<Aabb> triangle_bounds_;
  std::vector<std::array<Vec3, 3>> neighbour_normals_;
  std::vector<Child> children_;
};

/// A triangle as a polytope without volume.
[[nodiscard]] Polytope triangle_polytope(const Shape::Triangle& triangle);

}  // namespace plumb::referee
