// Kernels of convex shapes and planes, and the triangles of surfaces.
#include "narrowphase/cuda/collide_by_kind.cuh"

namespace plumb::impulse {

void collide_pieces(Executor& executor, Count candidates, const CollideInput& input, std::uint32_t shape_types) {
  using enum ShapeType;
  const auto run = [&](auto kind) { collide_kind(executor, candidates, input, shape_types, kind); };
  const auto run_all = [&]<ShapeType kB>(std::integral_constant<ShapeType, kB>) {
    run(OnePiece<kSphere, kB>{});
    run(OnePiece<kBox, kB>{});
    run(OnePiece<kCapsule, kB>{});
    run(OnePiece<kHull, kB>{});
    run(OnePiece<kCylinder, kB>{});
  };
  run_all(std::integral_constant<ShapeType, kPlane>{});
  run_all(std::integral_constant<ShapeType, kMesh>{});
  run_all(std::integral_constant<ShapeType, kHeightField>{});
}

}  // namespace plumb::impulse
