// Pair functions over all candidates of a step: on a CPU one loop with a branch a pair (collide_candidates.cpp), on a
// device a kernel for each pair of types, which has the code and registers of one pair function (collide_*_pairs.cu).
#pragma once

#include "bodies/body.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_recycling.hpp"
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
  NarrowPhaseWork work;
  const std::uint32_t* order;  ///< candidates by pair_kind; null where all are of one kind, or nobody asks
  const std::uint32_t* first;  ///< by pair_kind: its first place in the order
};

/// shape_types: a bit for each ShapeType in the scene.
void collide_candidates(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types);

/// Runs Kind::collide(shape_pair, proxies, triangle, manifold) on a candidate that is not recycled, and writes down
/// what it found.
template <class Kind>
PLUMB_HD void collide_candidate(const CollideInput& in, std::uint32_t p) {
  const ContactCache& cache = in.work.cache;
  if (cache.collided.is_recyclable(p)) return;  // and has been, in this step
  const Bodies& bodies = in.work.bodies;
  const Proxies& proxies = in.work.proxies;
  const Pair pair = cache.pairs[p];
  const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
  PLUMB_ASSERT(a.shape != kNone && b.shape != kNone && a.body != b.body);
  const Quat &qa = bodies.orientation[a.body], &qb = bodies.orientation[b.body];
  const ShapePose pose_a = shape_pose(a, qa), pose_b = shape_pose(b, qb);
  const Vec apart = between(bodies.position[a.body], bodies.position[b.body]) + pose_b.offset - pose_a.offset;
  const Shape &shape_a = proxies.shapes[a.shape], &shape_b = proxies.shapes[b.shape];
  const Real margin = in.work.margin(pair);
  Manifold manifold;
  const bool touch = Kind::collide({shape_a, shape_b, pose_a.orientation, pose_b.orientation, apart, margin}, proxies,
                                   cache.triangles == nullptr ? 0U : cache.triangles[p], manifold);
  PLUMB_ASSERT(!touch || (manifold.count >= 1 && manifold.count <= static_cast<std::uint32_t>(kManifoldPoints)));
  PLUMB_ASSERT(!touch || is_finite(manifold.normal));
  cache.touching[p] = touch ? 1 : 0;
  if (touch) cache.found[p] = manifold;
  if (!touch) manifold.count = 0;
  if (is_surface(shape_a.type) || is_surface(shape_b.type)) return;  // recycled as a whole (manifold_reduction.hpp)
  if (touch ? may_recycle(shape_a.type, shape_b.type, manifold) : manifold.gap > margin)
    cache.collided.store(p, {manifold, margin, qa, qb, bodies.position[b.body] - bodies.position[a.body]});
}

}  // namespace plumb::impulse
