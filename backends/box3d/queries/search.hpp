// One query of a batch on its way through Box3D's trees.
#pragma once

#include "world.hpp"

namespace plumb::box3d {

struct World::Search {
  const World& world;
  const PlumbFilter& filter;
  backend::HitCollector& found;

  /// Whose shape it is, where the query sees it; else null.
  [[nodiscard]] const Body* sees(b3ShapeId shape) const {
    const Body& body = world.owner(shape);
    return !body.is_sensor() && may_touch(filter, body.desc.filter) ? &body : nullptr;
  }
};

/// What Box3D's casts take as "not this one, go on".
inline constexpr float kIgnored = -1;

/// Calls run(query, collector) for each of a batch. The hits live until the next batch of the same thread.
template <class Query, class Run>
Hits gather(PlumbHitMode mode, std::span<const Query> queries, Run&& run) {
  thread_local std::vector<PlumbHit> hits;
  hits.clear();
  for (std::uint32_t i = 0; i < queries.size(); ++i) {
    backend::HitCollector collector(hits, i, mode);
    run(queries[i], collector);
    collector.finish();
  }
  return {PLUMB_OK, hits};
}

/// Box3D keeps only what a test at the tree's leaves finds; filters are ours.
inline b3QueryFilter all_seeing() { return b3DefaultQueryFilter(); }

}  // namespace plumb::box3d
