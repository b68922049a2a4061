// Pair functions over all candidates of a step: on a CPU one loop with a branch a pair (collide_candidates.cpp), on a
// device a kernel for each pair of types, which has the code and registers of one pair function (cuda/).
#pragma once

#include "bodies/body.hpp"
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
  /// By candidate: those that are collided once more, whose time is 0 afterwards where nothing touches. Null: all are,
  /// as they lie at the start.
  PairTime* again;
};

/// shape_types: a bit for each ShapeType in the scene.
void collide_candidates(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types);

/// How the shapes of two proxies lie at the start of the step, each pushing to its outside.
PLUMB_HD inline PairPlace place_at_start(const NarrowPhaseWork& work, const Proxy& a, const Proxy& b, Real margin) {
  const Bodies& bodies = work.bodies;
  PLUMB_ASSERT(a.shape != kNone && b.shape != kNone && a.body != b.body);
  const ShapePose pose_a = shape_pose(a, bodies.orientation[a.body]),
                  pose_b = shape_pose(b, bodies.orientation[b.body]);
  const Vec apart = between(bodies.position[a.body], bodies.position[b.body]) + pose_b.offset - pose_a.offset;
  return {pose_a.orientation, pose_b.orientation, apart, margin, false};
}
PLUMB_HD inline ShapePair shapes_at(const NarrowPhaseWork& work, const Proxy& a, const Proxy& b, const PairPlace& at) {
  const Shape* shapes = work.proxies.shapes;
  return {shapes[a.shape], shapes[b.shape], at.qa, at.qb, at.d, at.margin, at.from_behind};
}

/// What is kept of a candidate that has been collided as it lies, for the next step. Of surfaces all candidates are
/// recycled together (manifold_reduction.hpp).
PLUMB_HD inline void keep_collided(const NarrowPhaseWork& work, std::uint32_t p, std::uint32_t body_a,
                                   std::uint32_t body_b, const ShapePair& shapes, const Manifold& manifold) {
  if (is_surface(shapes.a.type) || is_surface(shapes.b.type)) return;
  const bool touch = manifold.count != 0;
  if (touch ? !may_recycle(shapes.a.type, shapes.b.type, manifold) : !(manifold.gap > shapes.margin)) return;
  const Bodies& bodies = work.bodies;
  work.cache.collided.store(p, {manifold, shapes.margin, bodies.orientation[body_a], bodies.orientation[body_b],
                                bodies.position[body_b] - bodies.position[body_a]});
}

/// Runs Kind::collide(shape_pair, proxies, triangle, manifold) on a candidate that is not recycled, and writes down
/// what it found; again, on one that is to be collided at a later time. Kind::kOnSheets: one may be a surface.
template <class Kind>
PLUMB_HD void collide_candidate(const CollideInput& in, std::uint32_t p) {
  const NarrowPhaseWork& work = in.work;
  const ContactCache& cache = work.cache;
  const bool again = in.again != nullptr;
  if (again ? !(in.again[p].time > 0) : cache.collided.is_recyclable(p)) return;  // recycled already in this step
  const Pair pair = cache.pairs[p];
  const std::uint32_t triangle = cache.triangles == nullptr ? 0U : cache.triangles[p];
  const Proxy &a = work.proxies.rows[pair.a], &b = work.proxies.rows[pair.b];
  ShapePair shapes = again ? shapes_at(work, a, b, in.again[p].at)
                           : shapes_at(work, a, b, place_at_start(work, a, b, work.margin(pair)));
  if constexpr (Kind::kOnSheets) {
    const bool on_sheet = is_surface(shapes.a.type) || is_surface(shapes.b.type);
    if (!again && on_sheet && work.is_continuous(pair))
      shapes.from_behind = is_behind(shapes, work.proxies.hulls, work.proxies.surfaces, triangle);
  }
  Manifold manifold;
  const bool touch = Kind::collide(shapes, work.proxies, triangle, manifold);
  PLUMB_ASSERT(!touch || (manifold.count >= 1 && manifold.count <= static_cast<std::uint32_t>(kManifoldPoints)));
  PLUMB_ASSERT(!touch || is_finite(manifold.normal));
  if (!touch) manifold.count = 0;
  if (touch) cache.found[p] = manifold;
  if (!again) {
    cache.touching[p] = touch ? 1 : 0;
    keep_collided(work, p, a.body, b.body, shapes, manifold);
  } else if (touch) {
    cache.touching[p] = 1;
  } else {
    in.again[p].time = 0;
  }
}

}  // namespace plumb::impulse
