// plumb.queries/1. Threads that ask at once take turns where something is built first; on a device, altogether.
#include "plugin/world.hpp"

namespace plumb::impulse {

HitNames World::hit_names() {
  if (queries_.hit_children_generation != rows_.generation) {
    queries_.hit_children.resize(proxies_.size());
    for (std::size_t i = 0; i < proxies_.size(); ++i) queries_.hit_children[i] = proxies_[i].child;
    queries_.hit_children_generation = rows_.generation;
  }
  return {rows_.ids, queries_.hit_children, rows_.generation};
}

template <class Ask>
Hits World::ask(const Ask& ask) {
  std::unique_lock lock(queries_.mutex);
  const QueryScene scene = simulation_.query_scene(hit_names());
  QueryBatch& batch = queries_.batches.take();
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
