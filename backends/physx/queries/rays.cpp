// Rays against the world as it stands.
#include "queries/search.hpp"

namespace plumb::px {

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  return gather(mode, rays, [&](const PlumbRay& ray, backend::HitCollector& found) {
    const PxVec3 origin = vector(ray.origin, "origin"), way = vector(ray.translation, "translation");
    const double length = backend::length(ray.translation);
    const auto sees = seen_by(ray.filter);
    SightOf sight(sees);
    auto hits = each<PxRaycastHit>([&](const PxRaycastHit& hit) {
      const Part& part = part_of(*hit.shape);
      found.add(part.body->handle, child_of(part, hit.faceIndex), static_cast<double>(hit.distance) / length,
                to_plumb(hit.position), to_plumb(hit.normal));
    });
    const PxVec3 unit = vector(backend::scale(1 / length, ray.translation), "translation").getNormalized();
    (void)scene_->raycast(
        origin, unit, way.magnitude(), hits,
        PxHitFlag::ePOSITION | PxHitFlag::eNORMAL | PxHitFlag::eFACE_INDEX | PxHitFlag::eMESH_BOTH_SIDES, look_at_all(),
        &sight);
  });
}

}  // namespace plumb::px
