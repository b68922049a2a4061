// Kernels of convex shapes without cylinders.
#include "narrowphase/cuda/collide_by_kind.cuh"

namespace plumb::impulse {

void collide_candidates(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types) {
  using enum ShapeType;
  const auto run = [&](auto kind) { collide_kind(executor, candidates, input, shape_types, kind); };
  run(OneKind<kSphere, kSphere, collide_sphere_sphere>{});
  run(OneKind<kSphere, kBox, collide_sphere_box>{});
  run(OneKind<kSphere, kCapsule, collide_sphere_capsule>{});
  run(OneKind<kSphere, kHull, collide_sphere_hull>{});
  run(OneKind<kBox, kBox, collide_box_box>{});
  run(OneKind<kBox, kCapsule, collide_box_capsule>{});
  run(OneKind<kBox, kHull, collide_box_hull>{});
  run(OneKind<kCapsule, kCapsule, collide_capsule_capsule>{});
  run(OneKind<kCapsule, kHull, collide_capsule_hull>{});
  run(OneKind<kHull, kHull, collide_hull_hull>{});
  collide_cylinders(executor, candidates, input, shape_types);
  collide_pieces(executor, candidates, input, shape_types);
}

}  // namespace plumb::impulse
