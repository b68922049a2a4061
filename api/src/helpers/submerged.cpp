#include <array>
#include <cmath>

#include "common.hpp"
#include "plumb/helpers/force_fields.hpp"

namespace plumb::helpers {
namespace {

const double pi = std::acos(-1.0);

/// A triangle cut at height 0: what is below has up to four corners.
struct Clipped {
  std::array<PlumbVec3, 4> corners;
  std::size_t count = 0;
  void put(const PlumbVec3& p) { corners[count++] = p; }
};

Clipped clip(const std::array<PlumbVec3, 3>& triangle, const std::array<double, 3>& heights) {
  Clipped below;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (heights[i] <= 0) below.put(triangle[i]);
    if ((heights[i] < 0 && heights[j] > 0) || (heights[i] > 0 && heights[j] < 0)) {
      const double t = heights[i] / (heights[i] - heights[j]);
      below.put(add(triangle[i], scale(t, sub(triangle[j], triangle[i]))));
    }
  }
  return below;
}

}  // namespace

Submerged submerged_sphere(const PlumbVec3& centre, double radius, const PlumbVec3& point, const PlumbVec3& up) {
  const double depth = std::min(2 * radius, radius - dot(sub(centre, point), up));
  if (depth <= 0) return {0, centre};
  const double volume = pi * depth * depth * (3 * radius - depth) / 3;
  const double below = 0.75 * (2 * radius - depth) * (2 * radius - depth) / (3 * radius - depth);
  return {volume, sub(centre, scale(below, up))};
}

Submerged submerged_hull(const Hull& hull, const PlumbPose& pose, const PlumbVec3& point, const PlumbVec3& up) {
  // Seen from the point of the plane nearest to the body, which keeps the sums small.
  const PlumbVec3 apex = sub(pose.position, scale(dot(sub(pose.position, point), up), up));
  double volume = 0;
  PlumbVec3 moment{};
  for (std::size_t i = 0; i + 2 < hull.indices.size(); i += 3) {
    std::array<PlumbVec3, 3> corners;
    std::array<double, 3> heights;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = sub(add(pose.position, rotate(pose.orientation, hull.vertices[hull.indices[i + k]])), apex);
      heights[k] = dot(corners[k], up);
    }
    const Clipped below = clip(corners, heights);
    for (std::size_t k = 2; k < below.count; ++k) {
      const PlumbVec3 &a = below.corners[0], &b = below.corners[k - 1], &c = below.corners[k];
      const double part = dot(a, cross(b, c)) / 6;
      volume += part;
      moment = add(moment, scale(part / 4, add(a, add(b, c))));
    }
  }
  if (volume <= 0) return {0, pose.position};
  return {volume, add(apex, scale(1 / volume, moment))};
}

Hull box_hull(const PlumbVec3& h) {
  Hull hull;
  for (int i = 0; i < 8; ++i) hull.vertices.push_back({i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z});
  hull.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return hull;
}

Hull cylinder_hull(double radius, double half_height, std::uint32_t sides) {
  require(sides >= 3, "cylinder hull: " + std::to_string(sides) + " sides: give 3 or more");
  const double step = 2 * pi / sides;
  const double corner = radius * std::sqrt(step / std::sin(step));  // of the polygon that has the circle's area
  Hull hull;
  hull.vertices = {{0, -half_height, 0}, {0, half_height, 0}};
  for (std::uint32_t i = 0; i < sides; ++i)
    for (const double y : {-half_height, half_height})
      hull.vertices.push_back({corner * std::cos(i * step), y, corner * std::sin(i * step)});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    for (const std::uint32_t index : {0u, a, b, 1u, b + 1, a + 1, a, a + 1, b + 1, a, b + 1, b})
      hull.indices.push_back(index);
  }
  return hull;
}

}  // namespace plumb::helpers
