#include "few_points.hpp"

#include <algorithm>

namespace plumb::dart6 {
namespace {

using ::dart::collision::Contact;
using Points = std::vector<Contact*>;

constexpr double kSameNormal = 0.995;  ///< cosine: within 5.7 degrees

/// The first of those for which the measure is largest.
template <class Measure>
Contact* most(const Points& points, Measure&& measure) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Contact* a, const Contact* b) { return measure(*a) < measure(*b); });
}

/// Deepest, farthest from it, farthest from the line through both, and farthest on that line's other side.
void take_corners(const Points& points, Points& kept) {
  if (points.size() <= 4) {
    kept.insert(kept.end(), points.begin(), points.end());
    return;
  }
  const Contact* first = most(points, [](const Contact& c) { return c.penetrationDepth; });
  const Contact* second = most(points, [&](const Contact& c) { return (c.point - first->point).squaredNorm(); });
  const Eigen::Vector3d across = first->normal.cross(second->point - first->point);
  const auto side = [&](const Contact& c) { return across.dot(c.point - first->point); };
  const Contact* left = most(points, side);
  const Contact* right = most(points, [&](const Contact& c) { return -side(c); });
  for (Contact* point : points)
    if (point == first || point == second || (point == left && side(*left) > 0) || (point == right && side(*right) < 0))
      kept.push_back(point);
}

}  // namespace

Points few_points(Points points) {
  Points kept;
  while (!points.empty()) {
    const Eigen::Vector3d normal = points.front()->normal;
    const auto others = std::stable_partition(
        points.begin(), points.end(), [&](const Contact* point) { return point->normal.dot(normal) > kSameNormal; });
    take_corners({points.begin(), others}, kept);
    points.erase(points.begin(), others);
  }
  return kept;
}

}  // namespace plumb::dart6
