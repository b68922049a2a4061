#include "convert/write/surface.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

#include "measure/instruments/mechanics.hpp"
#include "referee/hull.hpp"

namespace plumb::harness {
namespace {

using referee::Vec3;

Model surface_of_hull(const SceneShape& shape) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < shape.vertices.size(); i += 3)
    points.emplace_back(shape.vertices[i], shape.vertices[i + 1], shape.vertices[i + 2]);
  const referee::Hull hull = referee::convex_hull(points);
  Model surface;
  for (const Vec3& corner : hull.corners) surface.vertices.insert(surface.vertices.end(), corner.begin(), corner.end());
  for (const auto& triangle : hull.triangles)
    surface.indices.insert(surface.indices.end(), triangle.begin(), triangle.end());
  return surface;
}

}  // namespace

Model surface_of(const Scene& scene, std::size_t index) {
  const SceneShape& shape = scene.shapes[index];
  if (shape.desc.type == PLUMB_CONVEX_HULL) return surface_of_hull(shape);
  Model surface;
  std::map<std::array<double, 3>, std::uint32_t> corners;
  const referee::ShapePtr cut = shape_of(scene, index);
  for (const auto& triangle : cut->triangles())
    for (const Vec3& v : triangle) {
      const auto next = static_cast<std::uint32_t>(corners.size());
      const auto [corner, is_new] = corners.try_emplace({v.x(), v.y(), v.z()}, next);
      if (is_new) surface.vertices.insert(surface.vertices.end(), v.begin(), v.end());
      surface.indices.push_back(corner->second);
    }
  return surface;
}

std::string obj_of(const Model& surface) {
  std::string text;
  for (std::size_t i = 0; i < surface.vertices.size(); i += 3)
    text += fmt::format("v {} {} {}\n", surface.vertices[i], surface.vertices[i + 1], surface.vertices[i + 2]);
  for (std::size_t i = 0; i < surface.indices.size(); i += 3)
    text += fmt::format("f {} {} {}\n", surface.indices[i] + 1, surface.indices[i + 1] + 1, surface.indices[i + 2] + 1);
  return text;
}

}  // namespace plumb::harness
