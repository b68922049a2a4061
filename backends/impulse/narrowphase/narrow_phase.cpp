#include "narrowphase/narrow_phase.hpp"

#include "exec/atomic.hpp"
#include "narrowphase/collide.hpp"

namespace plumb::impulse {

namespace {

struct Collide {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Real* margins;

  PLUMB_HD void operator()(std::uint32_t p) const {
    const Pair pair = cache.pairs[p];
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
    const ShapePose pose_a = shape_pose(a, bodies.orientation[a.body]),
                    pose_b = shape_pose(b, bodies.orientation[b.body]);
    const Vec apart = between(bodies.position[a.body], bodies.position[b.body]) + pose_b.offset - pose_a.offset;
    Manifold manifold;
    const bool touch =
        impulse::collide(proxies.shapes[a.shape], pose_a.orientation, proxies.shapes[b.shape], pose_b.orientation,
                         apart, margins[pair.a] + margins[pair.b], proxies.hulls, manifold);
    cache.touching[p] = touch ? 1 : 0;
    if (touch) cache.found[p] = manifold;
  }
};

struct NumberRows {
  ContactCache cache;
  PLUMB_HD void operator()(std::uint32_t p) const {
    if (cache.touching[p] != 0) cache.candidate[cache.row[p]] = p;
  }
};

struct Match {
  ContactCache cache, last;
  Bodies bodies;
  Proxies proxies;
  const StepParameters* parameters;
  StepCounters* counters;
  std::uint64_t* masks;

  PLUMB_HD void operator()(std::uint32_t row) const {
    const std::uint32_t candidate = cache.candidate[row];
    const Pair pair = cache.pairs[candidate];
    const Manifold& found = cache.found[candidate];
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];

    CachedManifold kept;
    kept.normal = found.normal;
    kept.tangent = perpendicular(found.normal);
    kept.count = found.count;
    kept.colour = kNone;
    for (std::uint32_t i = 0; i < kManifoldPoints; ++i) {
      kept.feature[i] = i < found.count ? found.points[i].feature : 0;
      kept.normal_impulse[i] = kept.tangent_impulse[0][i] = kept.tangent_impulse[1][i] = 0;
    }
    const std::uint32_t step = parameters->step;
    const std::uint32_t old_row = a.born == step || b.born == step ? kNone : find_row(last, pair);
    if (old_row != kNone) remember(last.kept[old_row], kept);
    cache.kept[row] = kept;
    atomic_add(&counters->points, kept.count);
    if (kept.colour == kNone) return;
    const std::uint64_t bit = std::uint64_t{1} << kept.colour;
    if (bodies.velocity[a.body].inverse_mass > 0) atomic_or(&masks[a.body], bit);
    if (bodies.velocity[b.body].inverse_mass > 0) atomic_or(&masks[b.body], bit);
  }

 private:
  /// Impulses of points that are still there; those across the normal keep their direction in the world.
  PLUMB_HD static void remember(const CachedManifold& old, CachedManifold& kept) {
    if (old.colour < kOverflow) kept.colour = old.colour;
    const Vec old_bitangent = cross(old.normal, old.tangent), bitangent = cross(kept.normal, kept.tangent);
    for (std::uint32_t i = 0; i < kept.count; ++i)
      for (std::uint32_t j = 0; j < old.count; ++j) {
        if (kept.feature[i] != old.feature[j]) continue;
        const Vec friction = old.tangent_impulse[0][j] * old.tangent + old.tangent_impulse[1][j] * old_bitangent;
        kept.normal_impulse[i] = old.normal_impulse[j];
        kept.tangent_impulse[0][i] = dot(friction, kept.tangent);
        kept.tangent_impulse[1][i] = dot(friction, bitangent);
        break;
      }
  }
};

}  // namespace

void NarrowPhase::reserve(Executor& /*executor*/, std::uint32_t proxies, std::uint32_t pairs) {
  for (Storage& cache : caches_) {
    cache.pairs.grow(pairs);
    cache.ranges.grow(proxies);
    cache.found.grow(pairs);
    cache.touching.grow(pairs);
    cache.row.grow(pairs);
    cache.candidate.grow(pairs);
    cache.kept.grow(pairs);
  }
  scan_.reserve(pairs);
  capacity_ = pairs;
}

void NarrowPhase::forget() {
  for (Storage& cache : caches_) memory::fill(cache.ranges.data(), 0, cache.ranges.size() * sizeof(PairRange));
}

void NarrowPhase::collide(Executor& executor, const ContactCache& cache, const Bodies& bodies, const Proxies& proxies,
                          const Real* margins, StepCounters* counters) {
  const Count pairs = {&counters->pairs, capacity_};
  executor.run(pairs, Collide{cache, bodies, proxies, margins});
  scan_.run(executor, pairs, cache.touching, cache.row, &counters->manifolds);
  executor.run(pairs, NumberRows{cache});
}

void NarrowPhase::match(Executor& executor, const ContactCache& cache, const ContactCache& last, const Bodies& bodies,
                        const Proxies& proxies, const StepParameters* parameters, StepCounters* counters,
                        std::uint64_t* masks) {
  executor.run(Count{&counters->manifolds, capacity_},
               Match{cache, last, bodies, proxies, parameters, counters, masks});
}

}  // namespace plumb::impulse
