// plumb.queries/1 and plumb.closest/1. Threads that ask at once take turns where something is built first; on a device,
// altogether.
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

/// ask(batch, executor, scene), with a batch that this thread keeps until it asks again.
template <class Batch, class Ask>
auto World::ask(BatchPool<Batch>& batches, const Ask& ask) {
  std::unique_lock lock(queries_.mutex);
  const QueryScene scene = simulation_.query_scene(hit_names());
  Batch& batch = batches.take();
  if (kOneMemory) lock.unlock();
  return ask(batch, simulation_.executor(), scene);
}

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  return ask(queries_.batches, [&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return Hits{PLUMB_OK, batch.rays(executor, scene, mode, rays)};
  });
}

Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  return ask(queries_.batches, [&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return Hits{PLUMB_OK, batch.casts(executor, scene, mode, casts)};
  });
}

Hits World::turning_casts(PlumbHitMode mode, std::span<const PlumbTurningCast> casts) {
  return ask(queries_.batches, [&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return Hits{PLUMB_OK, batch.turning_casts(executor, scene, mode, casts)};
  });
}

Hits World::overlap_shapes(std::span<const PlumbOverlap> overlaps) {
  return ask(queries_.batches, [&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return Hits{PLUMB_OK, batch.overlaps(executor, scene, overlaps)};
  });
}

Penetrations World::penetrations(std::span<const PlumbOverlap> overlaps) {
  return ask(queries_.batches, [&](QueryBatch& batch, Executor& executor, const QueryScene& scene) {
    return Penetrations{PLUMB_OK, batch.penetrations(executor, scene, overlaps)};
  });
}

ClosestBodies World::closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) {
  return ask(queries_.closest_batches, [&](ClosestBatch& batch, Executor& executor, const QueryScene& scene) {
    return ClosestBodies{PLUMB_OK, batch.find(executor, scene, mode, probes)};
  });
}

}  // namespace plumb::impulse
