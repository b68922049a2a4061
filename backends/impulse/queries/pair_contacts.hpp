// Two posed shapes: their contacts as the step finds them, or how far they are apart.
#pragma once

#include "broadphase/pairs.hpp"
#include "exec/executor.hpp"
#include "narrowphase/manifold.hpp"
#include "queries/query_scene.hpp"

namespace plumb::impulse {

struct PosedPair {
  Shape a, b;
  Vec64 place_a, place_b;
  Quat64 turn_a, turn_b;  ///< unit
};

struct PairAnswer {
  double distance;    ///< m; of shapes that touch: of the deepest point, negative in overlap
  Vec64 normal;       ///< unit, from a to b: of the contact, or along the shortest way
  Vec64 at;           ///< from a's origin, world axes: the deepest point, or where a comes closest
  Manifold manifold;  ///< of shapes that touch; else count 0
};

/// Enqueues posed[i], the proxies of pairs[i] where they are in the scene, i < n; all where kernels run.
void pose_pairs(Executor& executor, const QueryScene& scene, const Pair* pairs, std::uint32_t n, PosedPair* posed);
/// Enqueues answers[i] for pairs[i], i < n; all where kernels run.
void answer_pairs(Executor& executor, const PosedPair* pairs, std::uint32_t n, const Hulls& hulls, PairAnswer* answers);

}  // namespace plumb::impulse
