// Bullet's quantized tree over the triangles of a mesh, as bytes: by its members, for Bullet's own bytes hold pointers
// and padding, and are believed whatever they say.
#pragma once

#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>

#include "plumb/backend/cooking.hpp"

namespace plumb::bullet {

class MeshTree final : public btOptimizedBvh {
 public:
  /// As btBvhTriangleMeshShape builds it. low, high: the mesh's box.
  MeshTree(btStridingMeshInterface& mesh, const btVector3& low, const btVector3& high) {
    build(&mesh, true, low, high);
  }
  /// Throws PLUMB_E_CORRUPT for bytes that are no tree over so many triangles.
  MeshTree(backend::CookedReader& in, std::uint32_t triangles);
  void cook(backend::CookedWriter& out) const;

 private:
  [[nodiscard]] bool is_sound(std::uint32_t triangles) const;
};

}  // namespace plumb::bullet
