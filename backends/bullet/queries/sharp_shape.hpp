// Convex shapes as what distances are asked of: boxes, cylinders and hulls up to their edges, which Bullet rounds off
// by its margin.
#pragma once

#include "shapes.hpp"

namespace plumb::bullet {

/// A view of a convex shape, which must outlive it. Spheres and capsules are a core and a margin, others have none.
class SharpShape final : public btConvexInternalShape {
 public:
  explicit SharpShape(const Shape& shape);

  /// The furthest point of the core along a direction, in the shape's axes.
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override;
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* points,
                                                         int count) const override;
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  const char* getName() const override { return "sharp"; }

 private:
  const Shape& shape_;
};

}  // namespace plumb::bullet
