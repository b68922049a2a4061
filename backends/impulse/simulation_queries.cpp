// What queries look at, between steps. It has lists of its own, so that a step is the same whether or not somebody
// asked before it.
#include "simulation.hpp"

namespace plumb::impulse {

/// Who has a shape, whether it moves, and whether a body has several.
void Simulation::list_for_queries() {
  PlacedProxies& placed = for_queries_->placed;
  Mirror<std::uint32_t>&movers = for_queries_->movers, &statics = for_queries_->statics, &planes = for_queries_->planes;
  movers.grow(proxies.size());
  statics.grow(proxies.size());
  placed.mover_count = placed.static_count = placed.plane_count = placed.types = 0;
  placed.several = false;
  std::vector<bool> has_one(state.size());
  for (std::uint32_t i = 0; i < proxy_count_; ++i) {
    if (proxies[i].shape == kNone || (filters[i].flags & kProxyUnseen) != 0) continue;
    const ShapeType type = shapes[proxies[i].shape].type;
    placed.types |= bit_of(type);
    const std::uint32_t body = proxies[i].body;
    placed.several = placed.several || has_one[body];
    has_one[body] = true;
    if (type == ShapeType::kPlane) {
      planes.grow(placed.plane_count + 1);
      planes[placed.plane_count++] = i;
    } else if ((mass[body].flags & kBodyMoves) != 0) {
      movers[placed.mover_count++] = i;
    } else {
      statics[placed.static_count++] = i;
    }
  }
  executor_.to_device(movers, placed.mover_count);
  executor_.to_device(statics, placed.static_count);
  if (placed.plane_count != 0) executor_.to_device(planes, placed.plane_count);
  const bool moves = placed.mover_count != 0;
  if (moves || placed.static_count != 0)
    placed.origin = middle_of(moves ? movers : statics, moves ? placed.mover_count : placed.static_count);
  placed.static_version = list_version_;
}

QueryScene Simulation::query_scene(const HitNames& names) {
  if (for_queries_ == nullptr) for_queries_ = std::make_unique<ForQueries>();
  PlacedProxies& placed = for_queries_->placed;
  if (placed.static_version != list_version_) list_for_queries();
  upload_bodies();
  placed.bodies = bodies();
  placed.proxies = proxy_view();
  placed.filters = filters.device();
  placed.rows = static_cast<std::uint32_t>(proxies.size());
  placed.movers = for_queries_->movers.device();
  placed.statics = for_queries_->statics.device();
  placed.planes = for_queries_->planes.device();
  placed.version = state.version();
  for_queries_->trees.update(executor_, placed, names);
  executor_.wait();
  return for_queries_->trees.scene(placed);
}

QueryScene Simulation::shape_scene() {
  shapes.upload(executor_);
  hulls.upload(executor_);
  surfaces.upload(executor_);
  QueryScene scene{};
  scene.shapes = shapes.device();
  scene.hulls = hulls.device();
  scene.surfaces = surfaces.device();
  return scene;
}

}  // namespace plumb::impulse
