// Who wakes where a surface is dug or raised: those that sleep on what is another there.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/CollideShape.h>
#include <Jolt/Physics/Collision/CollisionCollectorImpl.h>
#include <Jolt/Physics/Collision/CollisionDispatch.h>

#include <algorithm>

#include "world.hpp"

namespace plumb::jolt {
namespace {

struct Felt {
  std::size_t parts = 0;
  float deepest = -FLT_MAX;

  friend bool operator==(const Felt&, const Felt&) = default;
};

/// What a body feels of a surface that lies within the distance of it.
Felt feel(const JPH::Body& body, const JPH::Body& ground, const JPH::Shape& surface, float distance) {
  JPH::CollideShapeSettings how;
  how.mMaxSeparationDistance = distance;
  how.mActiveEdgeMode = JPH::EActiveEdgeMode::CollideWithAll;
  how.mBackFaceMode = JPH::EBackFaceMode::CollideWithBackFaces;
  JPH::AllHitCollisionCollector<JPH::CollideShapeCollector> all;
  const JPH::RVec3 base = body.GetCenterOfMassPosition();
  const JPH::Mat44 at_body = JPH::Mat44::sRotation(body.GetRotation()),
                   at_ground = JPH::Mat44::sRotationTranslation(
                       ground.GetRotation(),
                       JPH::Vec3(ground.GetPosition() - base) + ground.GetRotation() * surface.GetCenterOfMass());
  JPH::CollisionDispatch::sCollideShapeVsShape(body.GetShape(), &surface, JPH::Vec3::sOne(), JPH::Vec3::sOne(), at_body,
                                               at_ground, {}, {}, how, all);
  Felt felt{all.mHits.size()};
  for (const JPH::CollideShapeResult& hit : all.mHits) felt.deepest = std::max(felt.deepest, hit.mPenetrationDepth);
  return felt;
}

}  // namespace

/// before: what the body's shape was.
void World::wake_where_other(const Body& ground, const Shape& before) {
  if (!needs(PLUMB_NEED_SLEEPING)) return;
  const auto near = static_cast<float>(2 * settings_.speculative_distance);
  for (const auto& at : bodies_)
    if (at && at->asleep() && at->shape != nullptr &&
        feel(*at->jolt, *ground.jolt, *before.jolt, near) != feel(*at->jolt, *ground.jolt, *ground.shape->jolt, near))
      interface().ActivateBody(at->id());
}

}  // namespace plumb::jolt
