// A kernel for the candidates of one pair of types, known when it is compiled.
#pragma once

#include "narrowphase/collide_any.hpp"
#include "narrowphase/collide_candidates.hpp"

namespace plumb::impulse {

/// A function of collide.hpp.
using PairFunction = bool (*)(const ShapePair& pair, const Hulls& hulls, Manifold& out);

/// The pair with these shapes, which are its own in this order.
__device__ inline ShapePair in_order(const ShapePair& pair, const Shape& first, const Shape& second, bool swapped) {
  return {first,
          second,
          swapped ? pair.qb : pair.qa,
          swapped ? pair.qa : pair.qb,
          swapped ? -pair.d : pair.d,
          pair.margin,
          pair.from_behind};
}

/// Two convex shapes.
template <ShapeType kA, ShapeType kB, PairFunction kCollide>
struct OneKind {
  static constexpr std::uint32_t kTypes = bit_of(kA) | bit_of(kB), kNumber = pair_kind(kA, kB);
  static constexpr bool kOnSheets = false;

  __device__ static bool collide(const ShapePair& pair, const Proxies& proxies, std::uint32_t, Manifold& manifold) {
    const bool swapped = kA != kB && pair.a.type == kB;
    const Shape first = swapped ? pair.b : pair.a;
    const Shape second = swapped ? pair.a : pair.b;
    const bool touch = kCollide(in_order(pair, first, second, swapped), proxies.hulls, manifold);
    if (touch && swapped) swap_sides(pair.d, manifold);
    return touch;
  }
};

/// A convex shape and a piece of a kB.
template <ShapeType kA, ShapeType kB>
struct OnePiece {
  static constexpr std::uint32_t kTypes = bit_of(kA) | bit_of(kB), kNumber = pair_kind(kA, kB);
  static constexpr bool kOnSheets = kB != ShapeType::kPlane;

  __device__ static bool collide(const ShapePair& pair, const Proxies& proxies, std::uint32_t triangle,
                                 Manifold& manifold) {
    const bool swapped = pair.a.type == kB;
    const Shape first = swapped ? pair.b : pair.a;
    const Shape second = swapped ? pair.a : pair.b;
    const bool touch =
        collide_with_piece_of<kA, kB>(in_order(pair, first, second, swapped), proxies, triangle, manifold);
    if (touch && swapped) swap_sides(pair.d, manifold);
    return touch;
  }
};

/// Places first[0] to first[1] of the order; every candidate where there is no order.
template <class Kind>
struct CollideKind {
  CollideInput input;
  const std::uint32_t* first;

  __device__ void operator()(std::uint32_t i) const {
    const bool in_order = input.order != nullptr;
    if (in_order && i >= first[1] - first[0]) return;
    collide_candidate<Kind>(input, in_order ? input.order[first[0] + i] : i);
  }
};

/// Where the scene has shapes of both types.
template <class Kind>
void collide_kind(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types, Kind) {
  if ((shape_types & Kind::kTypes) == Kind::kTypes)
    executor.run(candidates, CollideKind<Kind>{input, input.first + Kind::kNumber});
}

/// Of collide_candidates(), in files of their own so that they are compiled side by side.
void collide_cylinders(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types);
void collide_pieces(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types);

}  // namespace plumb::impulse
