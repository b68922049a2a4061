// Rays, casts and overlaps: rows there, hits back, in the order that queries.h states.
#include <algorithm>
#include <limits>
#include <tuple>

#include "append.hpp"
#include "world.hpp"

namespace plumb::wire {

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  std::vector<double> row = {double(mode)};
  for (const PlumbRay& ray : rays) {
    append(row, ray.origin);
    append(row, ray.translation);
    append(row, ray.filter);
  }
  return hits_of(call(Call::kRays, row), mode, rays.size());
}

Hits World::cast_shapes(PlumbHitMode mode, std::span<const PlumbCast> casts) {
  std::vector<double> row = {double(mode)};
  for (const PlumbCast& cast : casts) {
    row.push_back(slot_of(cast.shape));
    append(row, cast.pose);
    append(row, cast.translation);
    append(row, cast.filter);
  }
  return hits_of(call(Call::kCasts, row), mode, casts.size());
}

Hits World::overlap_shapes(std::span<const PlumbOverlap> overlaps) {
  std::vector<double> row;
  for (const PlumbOverlap& overlap : overlaps) {
    row.push_back(slot_of(overlap.shape));
    append(row, overlap.pose);
    append(row, overlap.filter);
  }
  return hits_of(call(Call::kOverlaps, row), PLUMB_HIT_ALL, overlaps.size());
}

// Rows of 10: query, body, child, fraction, position, normal.
Hits World::hits_of(const Frame& reply, PlumbHitMode mode, std::size_t queries) const {
  constexpr std::size_t columns = 10;
  static thread_local std::vector<PlumbHit> hits;
  hits.clear();
  for (std::size_t at = 0; at + columns <= reply.numbers.size(); at += columns) {
    const double* row = &reply.numbers[at];
    PlumbHit hit{};
    hit.query = static_cast<std::uint32_t>(row[0]);
    hit.body = handle_of(row[1]);
    hit.child = static_cast<std::uint32_t>(row[2]);
    hit.fraction = row[3];
    hit.position = vec3_at(row + 4);
    hit.normal = vec3_at(row + 7);
    hits.push_back(hit);
  }
  std::sort(hits.begin(), hits.end(), [](const PlumbHit& a, const PlumbHit& b) {
    return std::tuple(a.query, a.fraction, slot_of(a.body)) < std::tuple(b.query, b.fraction, slot_of(b.body));
  });
  if (mode == PLUMB_HIT_ALL) {  // one a body: the first
    std::vector<PlumbHit> first;
    for (const PlumbHit& hit : hits)
      if (std::none_of(first.rbegin(), first.rend(),
                       [&](const PlumbHit& other) { return other.query == hit.query && other.body == hit.body; }))
        first.push_back(hit);
    hits = std::move(first);
    return {PLUMB_OK, hits};
  }
  std::vector<PlumbHit> closest(queries);
  for (std::size_t i = 0; i < queries; ++i) closest[i] = {0, static_cast<std::uint32_t>(i), 0, 1, {}, {}};
  for (const PlumbHit& hit : hits)
    if (hit.query < queries && closest[hit.query].body == 0) closest[hit.query] = hit;
  hits = std::move(closest);
  return {PLUMB_OK, hits};
}

}  // namespace plumb::wire
