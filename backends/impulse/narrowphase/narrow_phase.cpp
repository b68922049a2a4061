#include "narrowphase/narrow_phase.hpp"

#include "exec/atomic.hpp"
#include "narrowphase/collide_any.hpp"

namespace plumb::impulse {

namespace {

constexpr std::uint32_t kPairKinds = kShapeTypes * kShapeTypes;

/// A number for two types in either order.
PLUMB_HD constexpr std::uint32_t pair_kind(ShapeType a, ShapeType b) {
  const auto x = static_cast<std::uint32_t>(a), y = static_cast<std::uint32_t>(b);
  return min(x, y) * kShapeTypes + max(x, y);
}

/// Two shapes as they lie, and the triangle where one is a surface.
struct Placed {
  const Shape &a, &b;
  const Quat &qa, &qb;
  Vec apart;
  Real margin;
};

/// Any two convex shapes without cylinders: a branch a pair, which is what a CPU does best.
struct AnyKind {
  PLUMB_HD static bool collide(const Placed& p, const Proxies& proxies, std::uint32_t, Manifold& manifold) {
    if (p.a.type <= p.b.type) return collide_ordered(p.a, p.qa, p.b, p.qb, p.apart, p.margin, proxies.hulls, manifold);
    const bool touch = collide_ordered(p.b, p.qb, p.a, p.qa, -p.apart, p.margin, proxies.hulls, manifold);
    if (touch) swap_sides(p.apart, manifold);
    return touch;
  }
};

/// A convex shape and a piece of what is in pieces, in either order.
struct PieceKind {
  PLUMB_HD static bool collide(const Placed& p, const Proxies& proxies, std::uint32_t part, Manifold& manifold) {
    if (in_pieces(p.b.type))
      return collide_with_piece(p.a, p.qa, p.b, p.qb, p.apart, p.margin, proxies, part, manifold);
    const bool touch = collide_with_piece(p.b, p.qb, p.a, p.qa, -p.apart, p.margin, proxies, part, manifold);
    if (touch) swap_sides(p.apart, manifold);
    return touch;
  }
  PLUMB_HD static constexpr bool in_pieces(ShapeType type) { return static_cast<std::uint32_t>(type) >= kConvexTypes; }
};

/// Any two shapes.
struct AnyPiece {
  PLUMB_HD static bool collide(const Placed& p, const Proxies& proxies, std::uint32_t part, Manifold& manifold) {
    return PieceKind::in_pieces(p.a.type) || PieceKind::in_pieces(p.b.type)
               ? PieceKind::collide(p, proxies, part, manifold)
               : impulse::collide(p.a, p.qa, p.b, p.qb, p.apart, p.margin, proxies.hulls, manifold);
  }
};

/// Shapes whose types are known when the kernel is compiled, so that it has the code and registers of one pair
/// function.
template <ShapeType kA, ShapeType kB>
struct OneKind {
  PLUMB_HD static bool collide(const Placed& p, const Proxies& proxies, std::uint32_t, Manifold& manifold) {
    const bool swapped = kA != kB && p.a.type == kB;
    const Shape first = swapped ? p.b : p.a;
    const Shape second = swapped ? p.a : p.b;
    const Shape typed_first = {kA, first.hull, first.size, first.reach};
    const Shape typed_second = {kB, second.hull, second.size, second.reach};
    const bool touch = collide_convex(typed_first, swapped ? p.qb : p.qa, typed_second, swapped ? p.qa : p.qb,
                                      swapped ? -p.apart : p.apart, p.margin, proxies.hulls, manifold);
    if (touch && swapped) swap_sides(p.apart, manifold);
    return touch;
  }
};

/// The same for a piece of type kB.
template <ShapeType kA, ShapeType kB>
struct OnePiece {
  PLUMB_HD static bool collide(const Placed& p, const Proxies& proxies, std::uint32_t part, Manifold& manifold) {
    const bool swapped = p.a.type == kB;
    const Shape first = swapped ? p.b : p.a;
    const Shape second = swapped ? p.a : p.b;
    const Shape typed_first = {kA, first.hull, first.size, first.reach};
    const Shape typed_second = {kB, second.hull, second.size, second.reach};
    const bool touch = collide_with_piece(typed_first, swapped ? p.qb : p.qa, typed_second, swapped ? p.qa : p.qb,
                                          swapped ? -p.apart : p.apart, p.margin, proxies, part, manifold);
    if (touch && swapped) swap_sides(p.apart, manifold);
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
    const bool touch = Kind::collide({proxies.shapes[a.shape], proxies.shapes[b.shape], pose_a.orientation,
                                      pose_b.orientation, apart, margins[pair.a] + margins[pair.b]},
                                     proxies, cache.parts == nullptr ? 0U : cache.parts[p], manifold);
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
    const std::uint32_t part = cache.parts == nullptr ? 0U : cache.parts[candidate];
    const std::uint32_t old_row = a.born == step || b.born == step ? kNone : find_row(last, pair, part);
    const CachedManifold* old = old_row != kNone ? &last.kept[old_row] : nullptr;
    if (old == nullptr && woken != nullptr) old = find_kept(woken, parameters->woken_contacts, pair, part);
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
    if (in_pieces_) cache.parts.grow(pairs);
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
  const Count pairs = candidates(counters);
  const auto run = [&]<class Kind>(Kind, const std::uint32_t* order, const std::uint32_t* first) {
    executor.run(pairs, Collide<Kind>{cache, bodies, proxies, margins, order, first});
  };
  if constexpr (!Executor::kWarps) {
    if (in_pieces_ || (shape_types & bit_of(ShapeType::kCylinder)) != 0)
      run(AnyPiece{}, nullptr, nullptr);
    else
      run(AnyKind{}, nullptr, nullptr);
  } else {
    const bool one = (shape_types & (shape_types - 1)) == 0;
    if (!one) bin(executor, cache, proxies, counters);
    const auto run_kind = [&]<template <ShapeType, ShapeType> class Kind, ShapeType kA, ShapeType kB>(
                              Kind<kA, kB> kind) {
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
    run_kind(OneKind<kSphere, kCylinder>{});
    run_kind(OneKind<kBox, kCylinder>{});
    run_kind(OneKind<kCapsule, kCylinder>{});
    run_kind(OneKind<kHull, kCylinder>{});
    run_kind(OneKind<kCylinder, kCylinder>{});
    const auto run_pieces = [&]<ShapeType kB>(std::integral_constant<ShapeType, kB>) {
      run_kind(OnePiece<kSphere, kB>{});
      run_kind(OnePiece<kBox, kB>{});
      run_kind(OnePiece<kCapsule, kB>{});
      run_kind(OnePiece<kHull, kB>{});
      run_kind(OnePiece<kCylinder, kB>{});
    };
    run_pieces(std::integral_constant<ShapeType, kPlane>{});
    run_pieces(std::integral_constant<ShapeType, kMesh>{});
    run_pieces(std::integral_constant<ShapeType, kHeightField>{});
  }
}

void NarrowPhase::number(Executor& executor, const ContactCache& cache, StepCounters* counters) {
  const Count pairs = candidates(counters);
  scan_.run(executor, pairs, cache.touching, cache.row, &counters->manifolds);
  executor.run(pairs, NumberRows{cache});
}

/// Orders the pairs by kind, so that a warp does one kind of work.
void NarrowPhase::bin(Executor& executor, const ContactCache& cache, const Proxies& proxies, StepCounters* counters) {
  const Count pairs = candidates(counters);
  executor.run(pairs, SortKinds{cache, proxies, kinds_.data(), unordered_.data()});
  sort_.run(executor, pairs, kinds_.data(), unordered_.data(), sorted_kinds_.data(), order_.data(), 6);
  executor.run(kPairKinds + 1, FindKinds{sorted_kinds_.data(), pairs, first_.data()});
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

void NarrowPhase::exchange(Archive& archive, std::uint32_t parity, std::uint32_t proxies, const StepCounters& counters,
                           bool with_parts) {
  Storage& cache = caches_[parity % 2];
  const std::uint32_t candidates = candidate_count(counters);
  archive.rows(cache.pairs, candidates);
  if (with_parts)
    archive.rows(cache.parts, candidates);
  else if (in_pieces_ && archive.reads())
    cache.parts.from_host(std::vector<std::uint32_t>(candidates, 0U).data(), candidates);
  archive.rows(cache.ranges, proxies);
  archive.rows(cache.touching, candidates);
  archive.rows(cache.row, candidates);
  archive.rows(cache.kept, counters.manifolds);
}

std::vector<KeptPair> NarrowPhase::kept(std::uint32_t parity, const StepCounters& counters) const {
  const Storage& cache = caches_[parity % 2];
  const std::uint32_t candidates = candidate_count(counters);
  const std::vector<Pair> pairs = cache.pairs.to_host(candidates);
  const std::vector<std::uint32_t> parts = cache.parts.to_host(cache.parts.size() == 0 ? 0 : candidates);
  const std::vector<std::uint32_t> candidate = cache.candidate.to_host(counters.manifolds);
  const std::vector<CachedManifold> manifolds = cache.kept.to_host(counters.manifolds);
  std::vector<KeptPair> rows(manifolds.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::uint32_t c = candidate[row];
    rows[row] = {pairs[c], parts.empty() ? 0U : parts[c], manifolds[row]};
  }
  return rows;
}

}  // namespace plumb::impulse
