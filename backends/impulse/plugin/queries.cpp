// plumb.queries/1. Threads that ask at once take turns where something is built first; on a device, altogether.
#include "plugin/world.hpp"

namespace plumb::impulse {

HitNames World::hit_names() {
  if (hit_children_generation_ != row_generation_) {
    hit_children_.resize(proxies_.size());
    for (std::size_t i = 0; i < proxies_.size(); ++i) hit_children_[i] = proxies_[i].child;
    hit_children_generation_ = row_generation_;
  }
  return {row_ids_, hit_children_, row_generation_};
}

template <class Ask>
Hits World::ask(const Ask& ask) {
  std::unique_lock lock(query_mutex_);
  const QueryScene scene = simulation_.query_scene(hit_names());
  QueryBatch& batch = query_batches_.take();
  if (kOneMemory) lock.unlock();
  return {PLUMB_OK, ask(batch, simulation_.executor(), scene)};
}

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  return ask([&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return batch.rays(executor, scene, mode, rays);
  });
}

Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  return ask([&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return batch.casts(executor, scene, mode, casts);
  });
}

Hits World::overlap_shapes(std::span<const PlumbOverlap> overlaps) {
  return ask([&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return batch.overlaps(executor, scene, overlaps);
  });
}

}  // namespace plumb::impulse
