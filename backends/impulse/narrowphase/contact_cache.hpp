// Contacts that outlive a step: what the last step found, how its impulses ended, and where to find a pair's.
#pragma once

#include <cstdint>

#include "bodies/body.hpp"
#include "broadphase/pairs.hpp"
#include "narrowphase/collided_rows.hpp"
#include "narrowphase/manifold.hpp"

namespace plumb::impulse {

/// A manifold as the last step left it.
struct CachedManifold {
  Vec normal, tangent;
  std::uint32_t count;
  std::uint32_t colour;
  /// Who stood for its bodies when it was coloured; kNone for one that was not pushed then, and may be when it wakes.
  std::uint32_t owner_a, owner_b;
  std::uint32_t feature[kManifoldPoints];
  Real normal_impulse[kManifoldPoints];      ///< N s over the last sub-step
  Real tangent_impulse[2][kManifoldPoints];  ///< along tangent and along cross(normal, tangent)
  Vec moment;                                ///< of rolling friction, likewise, N m s
};

/// On which triangle of a surface each point of a manifold lies (manifold_reduction.hpp).
struct PointTriangles {
  std::uint32_t of[kManifoldPoints];
};

/// A manifold that was kept apart from a step's.
struct KeptPair {
  Pair pair;
  std::uint32_t triangle;
  CachedManifold kept;
};

/// Impulses of a manifold summed over a step, N s.
struct StepImpulses {
  Real normal[kManifoldPoints];
  Real tangent[2][kManifoldPoints];
};

/// How the shapes of a pair lie, as of a ShapePair.
struct PairPlace {
  Quat qa, qb;
  Vec d;
  Real margin;
  bool from_behind;
};
/// When a pair is to be collided a second time (continuous/impacts.hpp).
struct PairTime {
  Real time;     ///< s since the start of the step; 0: not again
  PairPlace at;  ///< then
};

/// Of ContactCache::touching, until manifolds are reduced: touches as it did, and has been reduced before.
constexpr std::uint32_t kCarried = 2;

/// Contacts of one step. Two of these take turns: this step's and the last one's.
struct ContactCache {
  Pair* pairs;                      ///< candidates of the broad phase
  PairRange* ranges;                ///< by proxy: the candidates that it found
  Manifold* found;                  ///< by candidate; valid where touching
  std::uint32_t* touching;          ///< by candidate: 1 or 0
  std::uint32_t* row;               ///< by candidate: its manifold's row where touching
  std::uint32_t* previous;          ///< by candidate: the same pair among the last step's candidates, or kNone
  CollidedRows collided;            ///< by candidate: what may be recycled in the next step
  std::uint32_t* candidate;         ///< by row
  CachedManifold* kept;             ///< by row
  std::uint32_t* triangles;         ///< by candidate: the triangle of a surface, or 0; null where nothing has pieces
  PointTriangles* point_triangles;  ///< by candidate: of its points, where a surface touches; likewise
};

/// Pair (a, b), or that part of it, among a step's candidates, or kNone. It is in the list of whichever of both found
/// it; guess: about how far down. A body on a fine mesh has thousands, in much the same order from step to step.
PLUMB_HD inline std::uint32_t find_candidate(const ContactCache& cache, Pair wanted, std::uint32_t triangle,
                                             std::uint32_t guess) {
  const auto is_it = [&](std::uint32_t p) {
    return is_same(cache.pairs[p], wanted) && (cache.triangles == nullptr || cache.triangles[p] == triangle);
  };
  const std::uint32_t owners[2] = {wanted.a, wanted.b};
  for (const std::uint32_t owner : owners) {
    const PairRange range = cache.ranges[owner];
    const std::uint32_t middle = min(guess, range.count);
    for (std::uint32_t away = 0; away < range.count; ++away) {
      if (middle + away < range.count && is_it(range.first + middle + away)) return range.first + middle + away;
      if (away < middle && is_it(range.first + middle - 1 - away)) return range.first + middle - 1 - away;
    }
  }
  return kNone;
}
/// How far down its owner's list a candidate is.
PLUMB_HD inline std::uint32_t place_in_list(const ContactCache& cache, std::uint32_t candidate) {
  const PairRange range = cache.ranges[cache.pairs[candidate].a];
  const bool of_a = candidate >= range.first && candidate - range.first < range.count;
  return candidate - (of_a ? range.first : cache.ranges[cache.pairs[candidate].b].first);
}
/// Whether one of a pair is a mesh or a height field, so that its candidates have triangles. A proxy that has been
/// removed since the step is neither.
PLUMB_HD inline bool has_surface(const Proxies& proxies, Pair pair) {
  const auto is_one = [&](std::uint32_t proxy) {
    const std::uint32_t shape = proxies.rows[proxy].shape;
    return shape != kNone && is_surface(proxies.shapes[shape].type);
  };
  return is_one(pair.a) || is_one(pair.b);
}
PLUMB_HD inline bool earlier(const KeptPair& x, const KeptPair& y) {
  if (x.pair.a != y.pair.a) return x.pair.a < y.pair.a;
  return x.pair.b != y.pair.b ? x.pair.b < y.pair.b : x.triangle < y.triangle;
}
/// Likewise among n pairs in ascending order; null where it is not.
PLUMB_HD inline const CachedManifold* find_kept(const KeptPair* pairs, std::uint32_t n, Pair wanted,
                                                std::uint32_t triangle) {
  const KeptPair sought = {wanted, triangle, {}};
  std::uint32_t low = 0, high = n;
  while (low < high) {
    const std::uint32_t middle = (low + high) / 2;
    if (earlier(pairs[middle], sought))
      low = middle + 1;
    else
      high = middle;
  }
  const bool found = low < n && !earlier(sought, pairs[low]);
  return found ? &pairs[low].kept : nullptr;
}

}  // namespace plumb::impulse
