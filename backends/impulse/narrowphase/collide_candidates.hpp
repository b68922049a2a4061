// Pair functions over all candidates of a step: on a CPU one loop with a branch a pair (collide_candidates.cpp), on a
// device a kernel for each pair of types, which has the code and registers of one pair function (collide_*_pairs.cu).
#pragma once

#include "bodies/body.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"
#include "narrowphase/shape_pair.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kPairKinds = kShapeTypes * kShapeTypes;

/// A number for two types in either order.
PLUMB_HD constexpr std::uint32_t pair_kind(ShapeType a, ShapeType b) {
  const auto x = static_cast<std::uint32_t>(a), y = static_cast<std::uint32_t>(b);
  return min(x, y) * kShapeTypes + max(x, y);
}

/// What is collided, and where the candidates of a kind are.
struct CollideInput {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Real* margins;         ///< by proxy
  const std::uint32_t* order;  ///< candidates by pair_kind; null where all are of one kind, or nobody asks
  const std::uint32_t* first;  ///< by pair_kind: its first place in the order
};

/// shape_types: a bit for each ShapeType in the scene.
void collide_candidates(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types);

/// Runs Kind::collide(shape_pair, proxies, triangle, manifold) on a candidate, and writes down what it found.
template <class Kind>
PLUMB_HD void collide_candidate(const CollideInput& in, std::uint32_t p) {
  const Pair pair = in.cache.pairs[p];
  const Proxy &a = in.proxies.rows[pair.a], &b = in.proxies.rows[pair.b];
  PLUMB_ASSERT(a.shape != kNone && b.shape != kNone && a.body != b.body);
  const ShapePose pose_a = shape_pose(a, in.bodies.orientation[a.body]),
                  pose_b = shape_pose(b, in.bodies.orientation[b.body]);
  const Vec apart = between(in.bodies.position[a.body], in.bodies.position[b.body]) + pose_b.offset - pose_a.offset;
  Manifold manifold;
  const bool touch = Kind::collide({in.proxies.shapes[a.shape], in.proxies.shapes[b.shape], pose_a.orientation,
                                    pose_b.orientation, apart, in.margins[pair.a] + in.margins[pair.b]},
                                   in.proxies, in.cache.triangles == nullptr ? 0U : in.cache.triangles[p], manifold);
  PLUMB_ASSERT(!touch || (manifold.count >= 1 && manifold.count <= static_cast<std::uint32_t>(kManifoldPoints)));
  PLUMB_ASSERT(!touch || is_finite(manifold.normal));
  in.cache.touching[p] = touch ? 1 : 0;
  if (touch) in.cache.found[p] = manifold;
}

}  // namespace plumb::impulse
