// What is read between steps: what queries look at, and rows of state. Queries have lists of their own, so that a step
// is the same whether or not somebody asked before it.
#include "world/simulation.hpp"

namespace plumb::impulse {

void Simulation::list_for_queries() {
  ForQueries& of = *for_queries_;
  of.lists.find(colliders, bodies.mass);
  std::vector<bool> has_one(bodies.size());
  of.placed.several = false;
  for (std::uint32_t proxy = 0; proxy < colliders.count; ++proxy) {
    if (!colliders.is_seen(proxy)) continue;
    const std::uint32_t body = colliders.proxies[proxy].body;
    of.placed.several = of.placed.several || has_one[body];
    has_one[body] = true;
  }
  for (ProxyList* list : {&of.lists.movers, &of.lists.statics, &of.lists.planes}) list->upload(executor_);
  const ProxyList& near = of.lists.movers.count() != 0 ? of.lists.movers : of.lists.statics;
  if (near.count() != 0) of.placed.origin = middle_of(near, colliders, bodies.state);
  of.placed.static_version = list_version_;
}

QueryScene Simulation::query_scene(const HitNames& names) {
  if (for_queries_ == nullptr) for_queries_ = std::make_unique<ForQueries>();
  PlacedProxies& placed = for_queries_->placed;
  if (placed.static_version != list_version_) list_for_queries();
  upload_bodies();
  placed.bodies = body_view();
  placed.proxies = colliders.view();
  placed.filters = colliders.filters.device();
  placed.rows = static_cast<std::uint32_t>(colliders.proxies.size());
  placed.movers = for_queries_->lists.movers.view();
  placed.statics = for_queries_->lists.statics.view();
  placed.planes = for_queries_->lists.planes.view();
  placed.types = for_queries_->lists.types;
  placed.version = bodies.state.version();
  for_queries_->trees.update(executor_, placed, names);
  executor_.wait();
  return for_queries_->trees.scene(placed);
}

QueryScene Simulation::shape_scene() {
  colliders.upload_shapes(executor_);
  QueryScene scene{};
  scene.shapes = colliders.shapes.device();
  scene.hulls = colliders.hulls.device();
  scene.surfaces = colliders.surfaces.device();
  return scene;
}

template <class Row>
std::shared_ptr<RowBlock<Row>> Simulation::rows(FieldRows<Row>& field, bool on_host) {
  if (field.want(on_host)) recorder_.forget();
  if (field.fresh(bodies.state.version(), on_host)) return field.block();
  if (field.fresh(bodies.state.version(), false)) {
    field.bring(executor_, bodies.count);
  } else {
    if (field.reserve(bodies.size(), true)) recorder_.forget();
    bodies.frames.upload(executor_);
    bodies.state.upload();
    field.write(executor_, body_view(), bodies.frames.device(), bodies.count);
  }
  field.written(bodies.state.version());
  executor_.wait();
  return field.block();
}

template std::shared_ptr<RowBlock<PoseRow>> Simulation::rows(FieldRows<PoseRow>& field, bool on_host);
template std::shared_ptr<RowBlock<VelocityRow>> Simulation::rows(FieldRows<VelocityRow>& field, bool on_host);

}  // namespace plumb::impulse
