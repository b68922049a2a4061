// Pair functions over all candidates of a step: on a CPU one loop with a branch a pair (collide_candidates.cpp), on a
// device a kernel for each pair of types, which has the code and registers of one pair function (cuda/).
#pragma once

#include "bodies/moving_shape.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_recycling.hpp"
#include "narrowphase/triangle/sided_surface.hpp"
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
  PairTime*
      again;  ///< by candidate, 0 afterwards where nothing touches; null: all are collided as they lie at the start
};

/// shape_types: a bit for each ShapeType in the scene.
void collide_candidates(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types);

/// Two shapes as they lie at the start of the step.
PLUMB_HD inline ShapePair pair_at_start(const NarrowPhaseWork& work, const Pair& pair) {
  const Bodies& bodies = work.bodies;
  const Proxy &a = work.proxies.rows[pair.a], &b = work.proxies.rows[pair.b];
  PLUMB_ASSERT(a.shape != kNone && b.shape != kNone && a.body != b.body);
  const ShapePose pose_a = shape_pose(a, bodies.orientation[a.body]),
                  pose_b = shape_pose(b, bodies.orientation[b.body]);
  const Vec apart = between(bodies.position[a.body], bodies.position[b.body]) + pose_b.offset - pose_a.offset;
  return {work.proxies.shapes[a.shape],
          work.proxies.shapes[b.shape],
          pose_a.orientation,
          pose_b.orientation,
          apart,
          work.margin(pair)};
}

/// The same as they will lie.
PLUMB_HD inline ShapePair pair_at(const NarrowPhaseWork& work, const Pair& pair, const PairTime& at) {
  const Bodies& bodies = work.bodies;
  const MovingShape a = moving_shape(bodies, work.proxies, *work.parameters, pair.a),
                    b = moving_shape(bodies, work.proxies, *work.parameters, pair.b);
  const ShapePose pose_a = a.pose(at.time), pose_b = b.pose(at.time);
  const Vec apart =
      between(bodies.position[work.proxies.rows[pair.a].body], bodies.position[work.proxies.rows[pair.b].body]);
  const Vec d = apart + at.time * (b.way.linear - a.way.linear) + pose_b.offset - pose_a.offset;
  return {*a.shape, *b.shape, pose_a.orientation, pose_b.orientation, d, at.margin};
}

/// What is kept of a candidate that has been collided as it lies, for the next step. Of surfaces all candidates are
/// recycled together (manifold_reduction.hpp).
PLUMB_HD inline void keep_collided(const NarrowPhaseWork& work, std::uint32_t p, const ShapePair& shapes,
                                   const Manifold& manifold) {
  if (is_surface(shapes.a.type) || is_surface(shapes.b.type)) return;
  const bool touch = manifold.count != 0;
  if (touch ? !may_recycle(shapes.a.type, shapes.b.type, manifold) : !(manifold.gap > shapes.margin)) return;
  const Bodies& bodies = work.bodies;
  const Pair pair = work.cache.pairs[p];
  const std::uint32_t a = work.proxies.rows[pair.a].body, b = work.proxies.rows[pair.b].body;
  work.cache.collided.store(p, {manifold, shapes.margin, bodies.orientation[a], bodies.orientation[b],
                                bodies.position[b] - bodies.position[a]});
}

/// Runs Kind::collide(shape_pair, proxies, triangle, manifold) on a candidate that is not recycled, and writes down
/// what it found; again, on one that is to be collided at a later time.
template <class Kind>
PLUMB_HD void collide_candidate(const CollideInput& in, std::uint32_t p) {
  const NarrowPhaseWork& work = in.work;
  const ContactCache& cache = work.cache;
  const bool again = in.again != nullptr;
  if (again ? !(in.again[p].time > 0) : cache.collided.is_recyclable(p)) return;  // recycled already in this step
  const Pair pair = cache.pairs[p];
  const std::uint32_t triangle = cache.triangles == nullptr ? 0U : cache.triangles[p];
  ShapePair shapes = again ? pair_at(work, pair, in.again[p]) : pair_at_start(work, pair);
  if (is_surface(shapes.a.type) || is_surface(shapes.b.type)) {
    const auto starts_behind = [&](const ShapePair& start) {
      return is_behind(start, work.proxies.hulls, work.proxies.surfaces, triangle);
    };
    shapes.from_behind =
        again ? starts_behind(pair_at_start(work, pair)) : work.is_continuous(pair) && starts_behind(shapes);
  }
  Manifold manifold;
  const bool touch = Kind::collide(shapes, work.proxies, triangle, manifold);
  PLUMB_ASSERT(!touch || (manifold.count >= 1 && manifold.count <= static_cast<std::uint32_t>(kManifoldPoints)));
  PLUMB_ASSERT(!touch || is_finite(manifold.normal));
  if (!touch) manifold.count = 0;
  if (touch) cache.found[p] = manifold;
  if (!again) {
    cache.touching[p] = touch ? 1 : 0;
    keep_collided(work, p, shapes, manifold);
  } else if (touch) {
    cache.touching[p] = 1;
  } else {
    in.again[p].time = 0;
  }
}

}  // namespace plumb::impulse
