// Compiled to PTX alone: kernels of the simplest pairs, which check_pair_kernels.cmake looks at.
#include "narrowphase/cuda/collide_by_kind.cuh"

namespace plumb::impulse {

using BallPairs = CollideKind<OneKind<ShapeType::kSphere, ShapeType::kSphere, collide_sphere_sphere>>;
using BallsOnPlanes = CollideKind<OnePiece<ShapeType::kSphere, ShapeType::kPlane>>;
template __global__ void run_counted_kernel<BallPairs>(const __grid_constant__ BallPairs, Count);
template __global__ void run_counted_kernel<BallsOnPlanes>(const __grid_constant__ BallsOnPlanes, Count);

}  // namespace plumb::impulse
