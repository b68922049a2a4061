// What queries look at: trees of tight boxes at the bodies' present places, and for each proxy all that a test of it
// reads in one row.
#pragma once

#include "bodies/body.hpp"
#include "broadphase/pair_filter.hpp"
#include "bvh/lbvh.hpp"
#include "plumb/types.h"
#include "queries/line_shapes.hpp"

// What is much code and not used all the time: a GPU's compiler makes one copy of it for all kernels of a file, which
// would else take it minutes.
#if defined(__CUDACC__)
#define PLUMB_OUT_OF_LINE __noinline__
#else
#define PLUMB_OUT_OF_LINE
#endif

namespace plumb::impulse {

/// A shape where it is in the world.
struct alignas(32) Target {
  Vec64 place;  ///< of the shape's origin
  Quat64 turn;  ///< unit
  Shape shape;
  std::uint32_t body;   ///< slot
  std::uint32_t child;  ///< of a compound, which of its children
};

/// Which types of shapes there are to meet.
enum class Kinds {
  kFew,  ///< spheres, boxes, capsules and hulls
  kAll
};
constexpr std::uint32_t kFewTypes =
    bit_of(ShapeType::kSphere) | bit_of(ShapeType::kBox) | bit_of(ShapeType::kCapsule) | bit_of(ShapeType::kHull);

struct QueryScene {
  TreeView movers, statics;  ///< leaves are proxies
  Position origin;           ///< that the trees' boxes are relative to
  const Target* targets;     ///< by proxy
  const ProxyFilter* filters;
  const PlumbBody* ids;  ///< by body slot
  const Shape* shapes;   ///< those that are cast or overlapped too
  Hulls hulls;
  bool several;  ///< whether a body may have more than one proxy
  Surfaces surfaces;
  ProxyRows planes;     ///< that are in no tree
  std::uint32_t types;  ///< a bit for each ShapeType there is to meet
};

inline bool has_few_types(const QueryScene& scene) { return (scene.types & ~kFewTypes) == 0; }

/// What is in no tree, where there may be any.
template <class Visit>
PLUMB_HD void visit_planes(const QueryScene& scene, Visit& visit) {
  for (std::uint32_t i = 0; i < scene.planes.count; ++i) visit(scene.planes[i]);
}

}  // namespace plumb::impulse
