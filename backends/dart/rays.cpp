// Rays, one after the other, by the geoms of DART's detector of ODE.
#include "plumb/backend/hit_collector.hpp"
#include "world.hpp"

namespace plumb::dart6 {
namespace {

/// m. ODE checks by assertions, which end the process, that directions have a length.
void require_length(std::uint32_t ray, double length) {
  if (length >= 1e-30 && length <= 1e30) return;
  throw Error(PLUMB_E_INVALID_ARGUMENT, "rays[" + std::to_string(ray) +
                                            "].translation is shorter than 1e-30 m or longer than 1e30 m, which ODE "
                                            "within DART cannot follow; take one between");
}

}  // namespace

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  thread_local std::vector<PlumbHit> hits;
  const std::lock_guard lock(query_mutex_);  // each moves ODE's geoms to where the skeletons are
  prepare();
  hits.clear();
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    backend::HitCollector found(hits, i, mode);
    const double all = length(rays[i].translation);
    require_length(i, all);
    const PlumbVec3 along = scale(1 / all, rays[i].translation);
    for (const RayMeeting& met : collisions_.meet_ray(skeletons_, rays[i].origin, along, all)) {
      const Body& body = *met.geom->body;
      if (body.is_sensor() || !may_touch(rays[i].filter, body.desc.filter)) continue;
      const bool mesh = met.geom->shape->type == PLUMB_TRIANGLE_MESH;
      found.add(body.handle, mesh ? met.triangle : met.geom->child, met.way / all, met.point, normalized(met.normal));
    }
    found.finish();
  }
  return {PLUMB_OK, hits};
}

Hits World::cast_shapes(PlumbHitMode, std::span<const PlumbCast>) {
  throw Error(PLUMB_E_UNSUPPORTED, "DART has no shape casts; cast rays");
}

Hits World::overlap_shapes(std::span<const PlumbOverlap>) {
  throw Error(PLUMB_E_UNSUPPORTED, "DART has no overlaps of a shape that no body has; make a sensor");
}

}  // namespace plumb::dart6
