// Contact recycling: bodies that have hardly moved against each other since their shapes were collided keep the
// manifold that was found then. Its points are carried along, and only when one of them has slid by a little are the
// shapes collided again, which costs many times as much.
//
//      .----------.          r_a, r_b: arms of a point, from the bodies' centres, when the shapes were collided. Each
//      |   a  \r_a|          body turns its own since; by how much their ends have come apart is the slide s, and
//      '-------*--'
//    .---------*------.          separation = separation then + n . s
//    |    r_b /   b   |
//
// After Box3D (Catto, 2026), within a fiftieth of its tolerance: a step carries the points of its contacts through its
// sub-steps in the same way, and further. Points that stay where they are let heaps come to rest: collided again and
// again, what lies flat has now these points and now those, and trembles.
//
// Shapes that were apart, where collision saw by how much, are apart for as long as they have not come that near.
//
// With meshes and height fields all that touched is recycled or nothing is, and then no triangle is looked for, either
// (midphase.cpp decides, for that is before). A terrain so costs what it is touched by, not what lies below.
//
// What is round is always collided. Where it rolls, neither body keeps the point in which they touch; held up by one
// that lags behind, a ball would roll for ever.
#pragma once

#include "exec/executor.hpp"
#include "narrowphase/narrow_phase_work.hpp"

namespace plumb::impulse {

/// Fills cache.previous of all candidates, and cache.collided, found and touching of those that are recycled.
void recycle_contacts(Executor& executor, Count candidates, const NarrowPhaseWork& work);

/// Whether a manifold of two shapes may be recycled. A cylinder that stands does not roll.
PLUMB_HD inline bool may_recycle(ShapeType a, ShapeType b, const Manifold& manifold) {
  constexpr std::uint32_t kRound = bit_of(ShapeType::kSphere) | bit_of(ShapeType::kCapsule);
  const std::uint32_t types = bit_of(a) | bit_of(b);
  return (types & kRound) == 0 && ((types & bit_of(ShapeType::kCylinder)) == 0 || manifold.count > 2);
}

}  // namespace plumb::impulse
