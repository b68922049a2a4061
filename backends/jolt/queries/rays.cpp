// Rays and shape casts against the world as it stands.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/RayCast.h>
#include <Jolt/Physics/Collision/ShapeCast.h>

#include <algorithm>

#include "queries/search.hpp"

namespace plumb::jolt {
namespace {

/// Jolt looks no further than the nearest hit so far, and a hair beyond it, as of equal ones the lower slot is told.
float early_out(const backend::HitCollector& found) {
  constexpr double hair = 1e-6;
  return static_cast<float>(std::min(found.nearest() + hair, 1.0 + hair));
}

}  // namespace

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  return gather(mode, rays, [&](const PlumbRay& ray, backend::HitCollector& found) {
    const JPH::RRayCast cast(position(ray.origin, "origin"), vector(ray.translation, "translation"));
    auto collector = each<JPH::CastRayCollector>([&](auto& search, const JPH::RayCastResult& hit) {
      const Part part(system_, hit.mBodyID, hit.mSubShapeID2);
      const JPH::RVec3 at = cast.GetPointOnRay(hit.mFraction);
      found.add(part.body.handle, part.child, static_cast<double>(hit.mFraction), to_plumb(at),
                to_plumb(part.jolt.GetWorldSpaceSurfaceNormal(hit.mSubShapeID2, at)));
      search.UpdateEarlyOutFraction(early_out(found));
    });
    system_.GetNarrowPhaseQueryNoLock().CastRay(cast, {}, collector, {}, {}, Seen(ray.filter));
  });
}

Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  return gather(mode, casts, [&](const PlumbCast& cast, backend::HitCollector& found) {
    const JPH::Shape& moved = *shape(cast.shape).jolt;
    const JPH::RVec3 base = position(cast.pose.position, "pose.position");
    const JPH::RMat44 start =
        JPH::RMat44::sTranslation(base) * centre_transform(moved, cast.pose, cast.pose.position);
    const JPH::RShapeCast sweep(&moved, JPH::Vec3::sOne(), start, vector(cast.translation, "translation"));
    auto how = exactly<JPH::ShapeCastSettings>();
    how.mBackFaceModeTriangles = how.mBackFaceModeConvex = JPH::EBackFaceMode::CollideWithBackFaces;
    auto collector = each<JPH::CastShapeCollector>([&](auto& search, const JPH::ShapeCastResult& hit) {
      const Part part(system_, hit.mBodyID2, hit.mSubShapeID2);
      const JPH::Vec3 normal = -hit.mPenetrationAxis.NormalizedOr(-sweep.mDirection.Normalized());
      found.add(part.body.handle, part.child, static_cast<double>(hit.mFraction),
                backend::add(cast.pose.position, to_plumb(hit.mContactPointOn2)), to_plumb(normal));
      search.UpdateEarlyOutFraction(early_out(found));
    });
    system_.GetNarrowPhaseQueryNoLock().CastShape(sweep, how, base, collector, {}, {}, Seen(cast.filter));
  });
}

}  // namespace plumb::jolt
