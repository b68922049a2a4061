// Rays against the world as it stands.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/CastResult.h>
#include <Jolt/Physics/Collision/RayCast.h>

#include <algorithm>

#include "queries/search.hpp"

namespace plumb::jolt {
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

}  // namespace plumb::jolt
