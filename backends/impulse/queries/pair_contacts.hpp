// Two posed shapes: their contacts as the step finds them, or how far they are apart.
#pragma once

#include "broadphase/pairs.hpp"
#include "exec/executor.hpp"
#include "exec/sort.hpp"
#include "narrowphase/manifold.hpp"
#include "queries/query_scene.hpp"

namespace plumb::impulse {

struct PosedShape {
  Shape shape;
  Vec64 place;
  Quat64 turn;  ///< unit
};
struct PosedPair {
  Shape a, b;
  Vec64 place_a, place_b;
  Quat64 turn_a, turn_b;  ///< unit
};

/// Whether it is for touches in pieces (below): one is a plane or a surface.
PLUMB_HD inline bool uses_midphase(const Shape& shape) { return (bit_of(shape.type) & kMidphaseTypes) != 0; }
PLUMB_HD inline bool uses_midphase(const PosedPair& pair) { return uses_midphase(pair.a) || uses_midphase(pair.b); }

struct PairAnswer {
  double distance;    ///< m; of shapes that touch: of the deepest point, negative in overlap; NaN: nothing is convex
  Vec64 normal;       ///< unit, from a to b: of the contact, or along the shortest way
  Vec64 at;           ///< from a's origin, world axes: the deepest point, or where a comes closest
  Manifold manifold;  ///< of shapes that touch; else count 0. Of a surface it is that with the deepest point
  std::uint32_t triangle;  ///< of a surface, which it is that touches or comes closest; else 0
  std::uint32_t touches;   ///< of a plane or a surface, how many pieces of it a step would find to touch; else 0
};

/// Enqueues posed[i], the proxies of pairs[i] where they are in the scene, i < n; all where kernels run.
void pose_pairs(Executor& executor, const QueryScene& scene, const Pair* pairs, std::uint32_t n, PosedPair* posed);
/// Enqueues answers[i] for pairs[i], i < n; all where kernels run. Of the scene it is what the shapes consist of.
/// pieces: whether there is a plane or a surface among them.
void answer_pairs(Executor& executor, const PosedPair* pairs, std::uint32_t n, const QueryScene& scene, bool pieces,
                  PairAnswer* answers);

/// What a step finds of pairs with planes and surfaces: a manifold for each triangle that is touched.
struct PieceTouch {
  Manifold manifold;
  std::uint32_t triangle;
};
class PieceTouches {
 public:
  /// Those of pairs[i] are [offsets()[i], offsets()[i + 1]) of the rows, for i < n, in the order of the surface's
  /// search; none of other pairs. pairs and the answers to them: where kernels run. Waits until it is done.
  void find(Executor& executor, const PosedPair* pairs, const PairAnswer* answers, std::uint32_t n,
            const QueryScene& scene);
  [[nodiscard]] const std::uint32_t* offsets() const { return offsets_.host(); }
  [[nodiscard]] const PieceTouch* rows() const { return rows_.host(); }

 private:
  Scan scan_;
  Buffer<std::uint32_t> counts_;
  Mirror<std::uint32_t> offsets_;  // the last is their number
  Mirror<PieceTouch> rows_;
};

}  // namespace plumb::impulse
