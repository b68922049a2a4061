// Rays, by MuJoCo's functions of single geoms, one after the other as MuJoCo does it itself; normals are ours.
#include "world.hpp"

namespace plumb::mujoco {
namespace {

/// m along the unit direction; below 0: none.
double way_to(const Model& model, int geom, const mjtNum* from, const mjtNum* along) {
  const mjModel* m = model.model.get();
  const mjData* d = model.data.get();
  switch (m->geom_type[geom]) {
    case mjGEOM_MESH: return mj_rayMesh(m, d, geom, from, along);
    case mjGEOM_HFIELD: return mj_rayHfield(m, d, geom, from, along);
    default:
      return mju_rayGeom(d->geom_xpos + 3 * geom, d->geom_xmat + 9 * geom, m->geom_size + 3 * geom, from, along,
                         m->geom_type[geom]);
  }
}

/// Goes on behind what is none of ours: a wall and the floor of a height field, at most.
template <class IsOurs>
double way_to_surface(const Model& model, int geom, const mjtNum* from, const mjtNum* along, IsOurs&& is_ours) {
  constexpr double behind = 1e-6;
  double gone = 0;
  for (int i = 0; i < 3; ++i) {
    const mjtNum start[3] = {from[0] + gone * along[0], from[1] + gone * along[1], from[2] + gone * along[2]};
    const double way = way_to(model, geom, start, along);
    if (way < 0) return way;
    if (is_ours(gone + way)) return gone + way;
    gone += way + behind;
  }
  return -1;
}

}  // namespace

/// MuJoCo's geoms are where its last sub-step began until they are asked again.
Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  thread_local std::vector<PlumbHit> hits;
  {
    const std::lock_guard lock(query_mutex_);
    prepare();
    mj_kinematics(model_.model.get(), model_.data.get());
  }
  hits.clear();
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    backend::HitCollector found(hits, i, mode);
    const double all = length(rays[i].translation);
    mjtNum from[3], along[3];
    put(rays[i].origin, from);
    put(scale(1 / all, rays[i].translation), along);
    for (int g = 0; g < model_.model->ngeom; ++g) {
      const Geom& geom = model_.geoms[static_cast<std::size_t>(g)];
      if (geom.body->is_sensor() || !may_touch(rays[i].filter, geom.body->desc.filter)) continue;
      const PlumbPose frame = compose(geom.body->pose, geom.at);
      const auto local = [&](double way) {
        const PlumbVec3 point = add(rays[i].origin, scale(way / all, rays[i].translation));
        return unrotate(frame.orientation, sub(point, frame.position));
      };
      const double way =
          way_to_surface(model_, g, from, along, [&](double at) { return is_on_surface(*geom.shape, local(at)); });
      if (way < 0 || way > all) continue;
      PlumbVec3 normal = rotate(frame.orientation, normal_at(*geom.shape, local(way)));
      if (geom.shape->type == PLUMB_HEIGHT_FIELD && dot(normal, rays[i].translation) > 0) normal = scale(-1, normal);
      found.add(geom.body->handle, geom.child, way / all, add(rays[i].origin, scale(way / all, rays[i].translation)),
                normal);
    }
    found.finish();
  }
  return {PLUMB_OK, hits};
}

Hits World::cast_shapes(PlumbHitMode, std::span<const PlumbCast>) {
  throw Error(PLUMB_E_UNSUPPORTED, "MuJoCo has no shape casts");
}

Hits World::overlap_shapes(std::span<const PlumbOverlap>) {
  throw Error(PLUMB_E_UNSUPPORTED, "MuJoCo has no overlap queries");
}

}  // namespace plumb::mujoco
