#include "referee/mesh/way_out.hpp"

#include <algorithm>

#include "referee/convex_distance.hpp"

namespace plumb::referee {

bool WayOut::cuts(std::size_t triangle, const Vec3& moved) const {
  const Polytope flat = triangle_polytope(mesh_.triangles()[triangle]);
  const ConvexView view_triangle{nullptr, &flat, Pose{}};
  const ConvexView view_convex{&convex_, nullptr, {pose_.rotation, pose_.position + moved}};
  const double distance = convex_distance(view_triangle, view_convex).distance;
  return distance == 0 || distance < convex_.rounding();
}

std::vector<std::size_t> WayOut::near(const Vec3& way) const {
  Aabb bounds = convex_.bounds(pose_);
  bounds.include(convex_.bounds({pose_.rotation, pose_.position + way}));
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < mesh_.triangles().size(); ++i)
    if (mesh_.triangle_bounds()[i].overlaps(bounds)) found.push_back(i);
  return found;
}

std::optional<double> WayOut::along(const Vec3& direction, double most) const {
  constexpr int halvings = 20;
  for (const std::size_t triangle : triangles_) {
    if (direction.dot(front_of(mesh_.triangles()[triangle])) < 0) return std::nullopt;
    if (cuts(triangle, most * direction)) return std::nullopt;
  }
  // Of two convex sets one of which moves straight on, the times at which they meet are one span.
  double way = 0;
  const auto leave = [&](std::size_t triangle) {
    double low = way, high = most;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (low + high) / 2;
      (cuts(triangle, middle * direction) ? low : high) = middle;
    }
    way = high;
  };
  for (const std::size_t triangle : triangles_)
    if (cuts(triangle, way * direction)) leave(triangle);
  const std::vector<std::size_t> others = near(most * direction);
  while (way < most) {
    const auto cut =
        std::find_if(others.begin(), others.end(), [&](std::size_t i) { return cuts(i, way * direction); });
    if (cut == others.end()) return way;
    if (cuts(*cut, most * direction)) break;
    leave(*cut);
  }
  return std::nullopt;
}

}  // namespace plumb::referee
