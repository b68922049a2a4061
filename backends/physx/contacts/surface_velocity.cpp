#include "contacts/surface_velocity.hpp"

namespace plumb::px {
namespace {

/// World axes.
PxVec3 runs(const PxShape& shape, const PxRigidActor& actor) {
  const Part& part = part_of(shape);
  const PlumbVec3& v = part.body->material_of(*part.piece).surface_velocity;
  return actor.getGlobalPose().rotate(
      PxVec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)));
}

}  // namespace

/// PhysX drives the velocity of the first against the second to the target: against it the surfaces stand.
void SurfaceVelocities::onContactModify(PxContactModifyPair* pairs, PxU32 count) {
  for (PxContactModifyPair* pair = pairs; pair != pairs + count; ++pair) {
    const PxVec3 target = runs(*pair->shape[1], *pair->actor[1]) - runs(*pair->shape[0], *pair->actor[0]);
    if (target.isZero()) continue;
    for (PxU32 i = 0; i < pair->contacts.size(); ++i) pair->contacts.setTargetVelocity(i, target);
  }
}

}  // namespace plumb::px
