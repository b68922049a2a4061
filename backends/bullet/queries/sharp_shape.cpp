#include "queries/sharp_shape.hpp"

#include "plumb/assert.hpp"

namespace plumb::bullet {
namespace {

btVector3 furthest_in_cylinder(const btVector3& half, const btVector3& direction) {
  const btScalar across = btSqrt(direction.x() * direction.x() + direction.z() * direction.z());
  const btScalar y = direction.y() < 0 ? -half.y() : half.y();
  if (!(across > 0)) return {0, y, 0};
  return {half.x() * (direction.x() / across), y, half.x() * (direction.z() / across)};
}

btVector3 furthest_vertex(const std::vector<btScalar>& vertices, const btVector3& direction) {
  PLUMB_ASSERT(vertices.size() >= 3);
  btVector3 best(vertices[0], vertices[1], vertices[2]);
  btScalar most = direction.dot(best);
  for (std::size_t i = 3; i + 2 < vertices.size(); i += 3) {
    const btVector3 vertex(vertices[i], vertices[i + 1], vertices[i + 2]);
    const btScalar here = direction.dot(vertex);
    if (!(here > most)) continue;
    most = here;
    best = vertex;
  }
  return best;
}

}  // namespace

SharpShape::SharpShape(const Shape& shape) : shape_(shape) {
  m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
  btScalar radius = 0;
  if (shape.type == PLUMB_SPHERE) radius = static_cast<const btSphereShape&>(*shape.bullet).getRadius();
  if (shape.type == PLUMB_CAPSULE) radius = static_cast<const btCapsuleShape&>(*shape.bullet).getRadius();
  setMargin(radius);
}

btVector3 SharpShape::localGetSupportingVertexWithoutMargin(const btVector3& direction) const {
  switch (shape_.type) {
    case PLUMB_BOX: {
      const btVector3 half = static_cast<const btBoxShape&>(*shape_.bullet).getHalfExtentsWithMargin();
      return {btFsels(direction.x(), half.x(), -half.x()), btFsels(direction.y(), half.y(), -half.y()),
              btFsels(direction.z(), half.z(), -half.z())};
    }
    case PLUMB_CAPSULE: {
      const btScalar half = static_cast<const btCapsuleShape&>(*shape_.bullet).getHalfHeight();
      return {0, direction.y() < 0 ? -half : half, 0};
    }
    case PLUMB_CYLINDER:
      return furthest_in_cylinder(static_cast<const btCylinderShape&>(*shape_.bullet).getHalfExtentsWithMargin(),
                                  direction);
    case PLUMB_CONVEX_HULL: return furthest_vertex(shape_.vertices, direction);
    default: return {0, 0, 0};
  }
}

void SharpShape::batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* points,
                                                                   int count) const {
  for (int i = 0; i < count; ++i) points[i] = localGetSupportingVertexWithoutMargin(directions[i]);
}

/// Nobody asks: it is in no world.
void SharpShape::calculateLocalInertia(btScalar /*mass*/, btVector3& inertia) const { inertia.setZero(); }

}  // namespace plumb::bullet
