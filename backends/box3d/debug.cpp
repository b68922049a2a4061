// What Box3D lets be seen: the bounds of shapes and the axes of manifolds. Its trees, candidate pairs, islands and
// colours stay within.
#include <algorithm>

#include "manifolds.hpp"

namespace plumb::box3d {

PlumbResult World::candidate_pairs(std::span<const PlumbDebugPair>&) {
  throw Error(PLUMB_E_UNSUPPORTED, "Box3D does not tell candidate pairs, only those that touch");
}

PlumbResult World::tree_boxes(std::span<const PlumbDebugBox>& boxes) {
  constexpr std::int32_t of_no_tree = -1;
  lent_.boxes.clear();
  for (const auto& body : bodies_) {
    if (!body) continue;
    for (const b3ShapeId shape : body->shapes) {
      const b3AABB bounds = b3Shape_GetAABB(shape);
      lent_.boxes.push_back({to_plumb(bounds.lowerBound), to_plumb(bounds.upperBound), body->handle, of_no_tree, 0});
    }
  }
  boxes = lent_.boxes;
  return PLUMB_OK;
}

PlumbResult World::separating_axes(std::span<const PlumbDebugAxis>& axes) {
  lent_.axes.clear();
  each_manifold([&](const b3ContactData&, const Body& a, const Body& b, const b3Manifold& manifold) {
    if (manifold.pointCount == 0) return;
    double least = static_cast<double>(manifold.points[0].separation);
    for (int i = 1; i < manifold.pointCount; ++i)
      least = std::min(least, static_cast<double>(manifold.points[i].separation));
    lent_.axes.push_back({a.handle, b.handle, to_plumb(manifold.normal), least});
  });
  axes = lent_.axes;
  return PLUMB_OK;
}

}  // namespace plumb::box3d
