#include "moving_mesh.hpp"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>

namespace plumb::bullet {
namespace {

/// Triangles are thickened by so much: GImpact's own number. Without it stacks of meshes never come to rest.
constexpr btScalar kMargin = btScalar(0.01);
/// And by no more than this share of the mesh's least half extent.
constexpr btScalar kThinMargin = btScalar(0.02);

/// What the shape leans on; a base, so that it is there before the shape and after it.
struct MeshArrays {
  MeshArrays(const Shape& mesh, const btTransform& offset) {
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
      const btVector3 at = offset * btVector3(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
      vertices.insert(vertices.end(), {at.x(), at.y(), at.z()});
    }
    triangles.addIndexedMesh(indexed_mesh(vertices, mesh.indices), PHY_INTEGER);
  }

  std::vector<btScalar> vertices;
  btTriangleIndexVertexArray triangles;
};

class MovingMesh final : private MeshArrays, public btGImpactMeshShape {
 public:
  MovingMesh(const Shape& mesh, const btTransform& offset) : MeshArrays(mesh, offset), btGImpactMeshShape(&triangles) {
    updateBound();
    const btVector3 half = (m_localAABB.m_max - m_localAABB.m_min) / 2;
    setMargin(std::min(kMargin, kThinMargin * half[half.minAxis()]));
    updateBound();
  }
};

}  // namespace

std::unique_ptr<btCollisionShape> make_moving_mesh(const Shape& mesh, const btTransform& offset) {
  return std::make_unique<MovingMesh>(mesh, offset);
}

void collide_moving_meshes(btCollisionDispatcher& dispatcher) {
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
}

}  // namespace plumb::bullet
