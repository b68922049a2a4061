#include "narrowphase/narrow_phase.hpp"

#include "exec/atomic.hpp"
#include "narrowphase/collide.hpp"

namespace plumb::impulse {

namespace {

constexpr std::uint32_t kPairKinds = kShapeTypes * kShapeTypes;

/// A number for two types in either order.
PLUMB_HD constexpr std::uint32_t pair_kind(ShapeType a, ShapeType b) {
  const auto x = static_cast<std::uint32_t>(a), y = static_cast<std::uint32_t>(b);
  return min(x, y) * kShapeTypes + max(x, y);
}

/// Any two shapes: a branch a pair, which is what a CPU does best.
struct AnyKind {
  PLUMB_HD static bool collide(const Shape& a, const Quat& qa, const Shape& b, const Quat& qb, const Vec& apart,
                               Real margin, const Hulls& hulls, Manifold& manifold) {
    return impulse::collide(a, qa, b, qb, apart, margin, hulls, manifold);
  }
};

/// Shapes whose types are known when the kernel is compiled, so that it has the code and registers of one pair
/// function.
template <ShapeType kA, ShapeType kB>
struct OneKind {
  PLUMB_HD static bool collide(Shape a, const Quat& qa, Shape b, const Quat& qb, const Vec& apart, Real margin,
                               const Hulls& hulls, Manifold& manifold) {
    const bool swapped = kA != kB && a.type == kB;
    const Shape first = swapped ? b : a;
    const Shape second = swapped ? a : b;
    const Shape typed_first = {kA, first.hull, first.size, first.reach};
    const Shape typed_second = {kB, second.hull, second.size, second.reach};
    const bool touch = collide_ordered(typed_first, swapped ? qb : qa, typed_second, swapped ? qa : qb,
                                       swapped ? -apart : apart, margin, hulls, manifold);
    if (touch && swapped) swap_sides(apart, manifold);
    return touch;
  }
};

/// Pairs of one kind: places first[0] to first[1] of the order; every pair where there is no order.
template <class Kind>
struct Collide {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Real* margins;
  const std::uint32_t* order;
  const std::uint32_t* first;

  PLUMB_HD void operator()(std::uint32_t i) const {
    if (order != nullptr && i >= first[1] - first[0]) return;
    const std::uint32_t p = order == nullptr ? i : order[first[0] + i];
    const Pair pair = cache.pairs[p];
    const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
    const ShapePose pose_a = shape_pose(a, bodies.orientation[a.body]),
                    pose_b = shape_pose(b, bodies.orientation[b.body]);
    const Vec apart = between(bodies.position[a.body], bodies.position[b.body]) + pose_b.offset - pose_a.offset;
    Manifold manifold;
    const bool touch =
        Kind::collide(proxies.shapes[a.shape], pose_a.orientation, proxies.shapes[b.shape], pose_b.orientation, apart,
                      margins[pair.a] + margins[pair.b], proxies.hulls, manifold);
    cache.touching[p] = touch ? 1 : 0;
    if (touch) cache.found[p] = manifold;
  }
};

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
  const StepCounters* counters;
  std::uint32_t capacity;
  std::uint32_t* first;
  PLUMB_HD void operator()(std::uint32_t kind) const {
    std::uint32_t low = 0, high = min(counters->pairs, capacity);
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
    if (cache.touching[p] != 0) cache.candidate[cache.row[p]] = p;
  }
};

struct ForgetFound {
  PairRange *ranges, *other_ranges;
  const std::uint32_t* statics;
  PLUMB_HD void operator()(std::uint32_t i) const { ranges[statics[i]] = other_ranges[statics[i]] = {0, 0}; }
};

struct Match {
  ContactCache cache, last;
  const KeptPair* woken;
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
    const CachedManifold* old = old_row != kNone ? &last.kept[old_row] : nullptr;
    if (old == nullptr && woken != nullptr) old = find_kept(woken, parameters->woken_contacts, pair);
    if (old != nullptr) remember(*old, kept);
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
        // Impulses of a body that came out not finite must not reach the next step.
        const bool sane = is_finite(friction) && is_finite(old.normal_impulse[j]);
        kept.normal_impulse[i] = sane ? old.normal_impulse[j] : 0;
        kept.tangent_impulse[0][i] = sane ? dot(friction, kept.tangent) : 0;
        kept.tangent_impulse[1][i] = sane ? dot(friction, bitangent) : 0;
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
  if (Executor::kWarps) {
    for (Buffer<std::uint32_t>* buffer : {&kinds_, &unordered_, &sorted_kinds_, &order_}) buffer->grow(pairs);
    first_.grow(kPairKinds + 2);
    sort_.reserve(pairs);
  }
  capacity_ = pairs;
}

void NarrowPhase::collide(Executor& executor, const ContactCache& cache, const Bodies& bodies, const Proxies& proxies,
                          const Real* margins, std::uint32_t shape_types, StepCounters* counters) {
  const Count pairs = {&counters->pairs, capacity_};
  const auto run = [&]<class Kind>(Kind, const std::uint32_t* order, const std::uint32_t* first) {
    executor.run(pairs, Collide<Kind>{cache, bodies, proxies, margins, order, first});
  };
  if constexpr (!Executor::kWarps) {
    run(AnyKind{}, nullptr, nullptr);
  } else {
    const bool one = (shape_types & (shape_types - 1)) == 0;
    if (!one) bin(executor, cache, proxies, counters);
    const auto run_kind = [&]<ShapeType kA, ShapeType kB>(OneKind<kA, kB> kind) {
      const auto there = [&](ShapeType type) { return (shape_types >> static_cast<std::uint32_t>(type) & 1U) != 0; };
      if (!there(kA) || !there(kB)) return;
      run(kind, one ? nullptr : order_.data(), one ? nullptr : first_.data() + pair_kind(kA, kB));
    };
    using enum ShapeType;
    run_kind(OneKind<kSphere, kSphere>{});
    run_kind(OneKind<kSphere, kBox>{});
    run_kind(OneKind<kSphere, kCapsule>{});
    run_kind(OneKind<kSphere, kHull>{});
    run_kind(OneKind<kBox, kBox>{});
    run_kind(OneKind<kBox, kCapsule>{});
    run_kind(OneKind<kBox, kHull>{});
    run_kind(OneKind<kCapsule, kCapsule>{});
    run_kind(OneKind<kCapsule, kHull>{});
    run_kind(OneKind<kHull, kHull>{});
  }
}

void NarrowPhase::number(Executor& executor, const ContactCache& cache, StepCounters* counters) {
  const Count pairs = {&counters->pairs, capacity_};
  scan_.run(executor, pairs, cache.touching, cache.row, &counters->manifolds);
  executor.run(pairs, NumberRows{cache});
}

/// Orders the pairs by kind, so that a warp does one kind of work.
void NarrowPhase::bin(Executor& executor, const ContactCache& cache, const Proxies& proxies, StepCounters* counters) {
  const Count pairs = {&counters->pairs, capacity_};
  executor.run(pairs, SortKinds{cache, proxies, kinds_.data(), unordered_.data()});
  sort_.run(executor, pairs, kinds_.data(), unordered_.data(), sorted_kinds_.data(), order_.data(), 4);
  executor.run(kPairKinds + 1, FindKinds{sorted_kinds_.data(), counters, capacity_, first_.data()});
}

void NarrowPhase::match(Executor& executor, const ContactCache& cache, const ContactCache& last, const KeptPair* woken,
                        const Bodies& bodies, const Proxies& proxies, const StepParameters* parameters,
                        StepCounters* counters, std::uint64_t* masks) {
  executor.run(Count{&counters->manifolds, capacity_},
               Match{cache, last, woken, bodies, proxies, parameters, counters, masks});
}

void NarrowPhase::forget_found(Executor& executor, const std::uint32_t* statics, std::uint32_t n) {
  executor.run(n, ForgetFound{caches_[0].ranges.data(), caches_[1].ranges.data(), statics});
}

void NarrowPhase::exchange(Archive& archive, std::uint32_t parity, std::uint32_t proxies,
                           const StepCounters& counters) {
  Storage& cache = caches_[parity % 2];
  archive.rows(cache.pairs, counters.pairs);
  archive.rows(cache.ranges, proxies);
  archive.rows(cache.touching, counters.pairs);
  archive.rows(cache.row, counters.pairs);
  archive.rows(cache.kept, counters.manifolds);
}

std::vector<KeptPair> NarrowPhase::kept(std::uint32_t parity, const StepCounters& counters) const {
  const Storage& cache = caches_[parity % 2];
  const std::vector<Pair> pairs = cache.pairs.to_host(counters.pairs);
  const std::vector<std::uint32_t> candidate = cache.candidate.to_host(counters.manifolds);
  const std::vector<CachedManifold> manifolds = cache.kept.to_host(counters.manifolds);
  std::vector<KeptPair> rows(manifolds.size());
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = {pairs[candidate[row]], manifolds[row]};
  return rows;
}

}  // namespace plumb::impulse
