#include "plumb/helpers/filtered_queries.hpp"

#include <algorithm>
#include <iterator>

#include "common.hpp"

namespace plumb::helpers {
namespace {

IQueries& queries_of(IPhysicsWorld& world) {
  return require_extension(world.queries(), "a filtered query", PLUMB_EXT_QUERIES, "PLUMB_NEED_QUERIES");
}

/// Of all hits, which are sorted by query and then by fraction.
std::vector<PlumbHit> nearest_of(const IPhysicsWorld& world, const Hits& all, std::size_t queries,
                                 const HitFilter& counts) {
  check(world, all.result);
  std::vector<PlumbHit> nearest(queries);
  for (std::size_t i = 0; i < queries; ++i) nearest[i].query = static_cast<std::uint32_t>(i);
  for (const PlumbHit& hit : all.hits)
    if (nearest[hit.query].body == 0 && counts(hit)) nearest[hit.query] = hit;
  return nearest;
}

}  // namespace

HitFilter all_but(std::span<const PlumbBody> bodies) {
  std::vector<PlumbBody> sorted(bodies.begin(), bodies.end());
  std::sort(sorted.begin(), sorted.end());
  return [refused = std::move(sorted)](const PlumbHit& hit) {
    return !std::binary_search(refused.begin(), refused.end(), hit.body);
  };
}

std::vector<PlumbHit> closest_hits(IPhysicsWorld& world, std::span<const PlumbRay> rays, const HitFilter& counts) {
  return nearest_of(world, queries_of(world).cast_rays(PLUMB_HIT_ALL, rays), rays.size(), counts);
}

std::vector<PlumbHit> closest_hits(IPhysicsWorld& world, std::span<const PlumbCast> casts, const HitFilter& counts) {
  return nearest_of(world, queries_of(world).cast_shapes(PLUMB_HIT_ALL, casts), casts.size(), counts);
}

std::vector<PlumbHit> overlaps(IPhysicsWorld& world, std::span<const PlumbOverlap> overlaps, const HitFilter& counts) {
  const Hits all = queries_of(world).overlap_shapes(overlaps);
  check(world, all.result);
  std::vector<PlumbHit> counted;
  std::copy_if(all.hits.begin(), all.hits.end(), std::back_inserter(counted), counts);
  return counted;
}

std::vector<PlumbPenetration> penetrations(IPhysicsWorld& world, std::span<const PlumbOverlap> overlaps,
                                           const HitFilter& counts) {
  const Penetrations all = queries_of(world).penetrations(overlaps);
  check(world, all.result);
  std::vector<PlumbPenetration> counted;
  std::copy_if(all.rows.begin(), all.rows.end(), std::back_inserter(counted), [&](const PlumbPenetration& row) {
    return counts({row.body, row.query, row.child, 0, row.position, row.normal});
  });
  return counted;
}

}  // namespace plumb::helpers
