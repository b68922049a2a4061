#include "narrowphase/narrow_phase.hpp"

#include <bit>

#include "exec/atomic.hpp"
#include "narrowphase/collide_candidates.hpp"
#include "narrowphase/contact_recycling.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct SortKinds {
  ContactCache cache;
  Proxies proxies;
  std::uint32_t *kinds, *pairs;
  PLUMB_HD void operator()(std::uint32_t p) const {
    const Pair pair = cache.pairs[p];
    kinds[p] =
        pair_kind(proxies.shapes[proxies.rows[pair.a].shape].type, proxies.shapes[proxies.rows[pair.b].shape].type);
    pairs[p] = p;
  }
};

/// Where a kind begins in the order.
struct FindKinds {
  const std::uint32_t* kinds;
  Count pairs;
  std::uint32_t* first;
  PLUMB_HD void operator()(std::uint32_t kind) const {
    std::uint32_t low = 0, high = min(*pairs.value, pairs.capacity);
    while (low < high) {
      const std::uint32_t middle = (low + high) / 2;
      if (kinds[middle] < kind)
        low = middle + 1;
      else
        high = middle;
    }
    first[kind] = low;
  }
};

struct NumberRows {
  ContactCache cache;
  PLUMB_HD void operator()(std::uint32_t p) const {
    PLUMB_ASSERT(cache.touching[p] <= 1);
    if (cache.touching[p] != 0) cache.candidate[cache.row[p]] = p;
  }
};

struct ForgetFound {
  PairRange *ranges, *other_ranges;
  const std::uint32_t* statics;
  PLUMB_HD void operator()(std::uint32_t i) const { ranges[statics[i]] = other_ranges[statics[i]] = {0, 0}; }
};

void exchange(Archive& archive, CollidedManifold& collided) {
  archive.value(collided.apart);
  archive.value(collided.orientation_a);
  archive.value(collided.orientation_b);
  archive.value(collided.margin);
  Manifold& manifold = collided.manifold;
  archive.value(manifold.normal);
  archive.value(manifold.count);
  for (ManifoldPoint* point = manifold.points; point != manifold.points + manifold.count; ++point) {
    archive.value(point->position);
    archive.value(point->separation);
    archive.value(point->feature);
  }
}

/// The manifolds that may be recycled, where they are, and on which triangles their points lie in worlds that know it.
/// What is apart is collided again without being missed.
void exchange_collided(Archive& archive, Buffer<CollidedRows::Line>& buffer, Buffer<PointTriangles>* triangles_buffer,
                       std::uint32_t candidates) {
  const std::size_t n = CollidedRows::lines_for(candidates);
  std::vector<CollidedRows::Line> lines = archive.reads() ? std::vector<CollidedRows::Line>(n) : buffer.to_host(n);
  const CollidedRows rows = {lines.data()};
  std::vector<PointTriangles> triangles(triangles_buffer == nullptr ? 0 : candidates);
  if (!archive.reads() && triangles_buffer != nullptr) triangles = triangles_buffer->to_host(candidates);
  std::vector<std::uint32_t> recyclable;
  for (std::uint32_t p = 0; p < candidates && !archive.reads(); ++p)
    if (rows.load(p).manifold.count != 0) recyclable.push_back(p);
  archive.list(recyclable);
  for (const std::uint32_t p : recyclable) {
    CollidedManifold collided = rows.load(p);
    exchange(archive, collided);
    rows.store(p, collided);
    for (std::uint32_t i = 0; i < collided.manifold.count && triangles_buffer != nullptr; ++i)
      archive.value(triangles[p].of[i]);
  }
  if (!archive.reads()) return;
  buffer.from_host(lines.data(), n);
  if (triangles_buffer != nullptr) triangles_buffer->from_host(triangles.data(), candidates);
}

}  // namespace

void NarrowPhase::reserve(Executor& /*executor*/, std::uint32_t proxies, std::uint32_t pairs) {
  for (Storage& cache : caches_) {
    cache.pairs.grow(pairs);
    cache.ranges.grow(proxies);
    cache.found.grow(pairs);
    cache.touching.grow(pairs);
    cache.row.grow(pairs);
    cache.previous.grow(pairs);
    cache.collided.grow(CollidedRows::lines_for(pairs));
    cache.candidate.grow(pairs);
    cache.kept.grow(pairs);
    if (!uses_midphase_) continue;
    cache.triangles.grow(pairs);
    cache.point_triangles.grow(pairs);
  }
  scan_.reserve(pairs);
  if (Executor::kWarps) {
    for (Buffer<std::uint32_t>* buffer : {&kinds_, &unordered_, &sorted_kinds_, &order_}) buffer->grow(pairs);
    first_.grow(kPairKinds + 2);
    sort_.reserve(pairs);
  }
  capacity_ = pairs;
}

void NarrowPhase::collide(Executor& executor, const NarrowPhaseWork& work, std::uint32_t shape_types,
                          StepCounters* counters) {
  recycle_contacts(executor, candidates(counters), work);
  if (bins(shape_types)) bin(executor, work.cache, work.proxies, counters);
  run_pairs(executor, work, shape_types, counters, nullptr);
}

void NarrowPhase::run_pairs(Executor& executor, const NarrowPhaseWork& work, std::uint32_t shape_types,
                            StepCounters* counters, PairTime* again) {
  collide_candidates(executor, candidates(counters),
                     {work, bins(shape_types) ? order_.data() : nullptr, first_.data(), again}, shape_types);
}

void NarrowPhase::number(Executor& executor, const ContactCache& cache, StepCounters* counters) {
  const Count pairs = candidates(counters);
  scan_.run(executor, pairs, cache.touching, cache.row, &counters->manifolds);
  executor.run(pairs, NumberRows{cache});
}

void NarrowPhase::bin(Executor& executor, const ContactCache& cache, const Proxies& proxies, StepCounters* counters) {
  const Count pairs = candidates(counters);
  executor.run(pairs, SortKinds{cache, proxies, kinds_.data(), unordered_.data()});
  sort_.run(executor, pairs, kinds_.data(), unordered_.data(), sorted_kinds_.data(), order_.data(),
            std::bit_width(kPairKinds - 1));
  executor.run(kPairKinds + 1, FindKinds{sorted_kinds_.data(), pairs, first_.data()});
}

void NarrowPhase::forget_found(Executor& executor, const std::uint32_t* statics, std::uint32_t n) {
  executor.run(n, ForgetFound{caches_[0].ranges.data(), caches_[1].ranges.data(), statics});
}

void NarrowPhase::exchange(Archive& archive, std::uint32_t parity, std::uint32_t proxies,
                           const StepCounters& counters) {
  Storage& cache = caches_[parity % 2];
  const std::uint32_t candidates = candidate_count(counters);
  archive.rows(cache.pairs, candidates);
  if (uses_midphase_) archive.rows(cache.triangles, candidates);
  archive.rows(cache.ranges, proxies);
  archive.rows(cache.touching, candidates);
  archive.rows(cache.row, candidates);
  archive.rows(cache.kept, counters.manifolds);
  exchange_collided(archive, cache.collided, uses_midphase_ ? &cache.point_triangles : nullptr, candidates);
}

std::vector<KeptPair> NarrowPhase::kept(std::uint32_t parity, const StepCounters& counters) const {
  const Storage& cache = caches_[parity % 2];
  const std::uint32_t candidates = candidate_count(counters);
  const std::vector<Pair> pairs = cache.pairs.to_host(candidates);
  const std::vector<std::uint32_t> triangles = cache.triangles.to_host(cache.triangles.size() == 0 ? 0 : candidates);
  const std::vector<std::uint32_t> candidate = cache.candidate.to_host(counters.manifolds);
  const std::vector<CachedManifold> manifolds = cache.kept.to_host(counters.manifolds);
  std::vector<KeptPair> rows(manifolds.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::uint32_t c = candidate[row];
    rows[row] = {pairs[c], triangles.empty() ? 0U : triangles[c], manifolds[row]};
  }
  return rows;
}

}  // namespace plumb::impulse
