// Kernels of convex shapes and cylinders.
#include "narrowphase/cuda/collide_by_kind.cuh"

namespace plumb::impulse {

void collide_cylinders(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types) {
  using enum ShapeType;
  const auto run = [&](auto kind) { collide_kind(executor, candidates, input, shape_types, kind); };
  run(OneKind<kSphere, kCylinder, collide_sphere_cylinder>{});
  run(OneKind<kBox, kCylinder, collide_box_cylinder>{});
  run(OneKind<kCapsule, kCylinder, collide_capsule_cylinder>{});
  run(OneKind<kHull, kCylinder, collide_hull_cylinder>{});
  run(OneKind<kCylinder, kCylinder, collide_cylinder_cylinder>{});
}

}  // namespace plumb::impulse
