// How far apart two pieces of shapes are: convex shapes, triangles and planes.
#pragma once

#include <extensions/PxGjkQueryExt.h>
#include <geometry/PxGjkQuery.h>

#include "physx_math.hpp"

namespace plumb::px {

/// A triangle as PhysX's search takes convex shapes.
struct TriangleSupport final : PxGjkQuery::Support {
  PxVec3 corners[3];

  [[nodiscard]] PxReal getMargin() const override { return 0; }
  [[nodiscard]] PxVec3 supportLocal(const PxVec3& direction) const override;
};

/// A convex shape, a triangle or a plane at a place.
class Leaf {
 public:
  /// geometry: a convex one or a plane; it outlives the leaf.
  Leaf(const PxGeometry& geometry, const PxTransform& at);
  explicit Leaf(const PxTriangle& triangle);  ///< in the common frame
  Leaf(const Leaf&) = delete;
  Leaf& operator=(const Leaf&) = delete;

  [[nodiscard]] bool is_plane() const { return is_plane_; }
  /// Of a plane: its normal is x of its frame.
  [[nodiscard]] const PxTransform& at() const { return at_; }
  [[nodiscard]] const PxGjkQuery::Support& support() const;
  [[nodiscard]] const PxGeometry* geometry() const { return geometry_; }  ///< null: a triangle
  /// Of a triangle: across it.
  [[nodiscard]] PxVec3 across() const;
  /// The point that is furthest in a direction, a unit.
  [[nodiscard]] PxVec3 furthest(const PxVec3& direction) const;
  void move(const PxVec3& by) { at_.p += by; }

 private:
  PxTransform at_;
  const PxGeometry* geometry_ = nullptr;
  PxGjkQueryExt::ConvexGeomSupport convex_;
  const PxGjkQuery::Support* cylinder_ = nullptr;  ///< or null
  TriangleSupport triangle_;
  bool is_plane_ = false, is_triangle_ = false;
};

struct Between {
  double distance = 0;  ///< m, below 0: how deep they overlap
  PxVec3 on_a, on_b;    ///< m: of their surfaces
  PxVec3 normal;        ///< unit, from a to b
};

/// Not of two planes.
[[nodiscard]] Between between(const Leaf& a, const Leaf& b);

}  // namespace plumb::px
