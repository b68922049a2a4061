// Triangle meshes, and height fields as meshes: Jolt's own are square and round their heights.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/Shape/MeshShape.h>

#include "shapes.hpp"

namespace plumb::jolt {
namespace {

JPH::Float3 corner(const PlumbVec3& v, const char* name) {
  return {scalar(v.x, name), scalar(v.y, name), scalar(v.z, name)};
}

/// Each triangle keeps its number, as Jolt sorts them and drops those without an area.
JPH::Shape::ShapeResult make(JPH::VertexList corners, JPH::IndexedTriangleList triangles) {
  for (std::uint32_t i = 0; i < triangles.size(); ++i) triangles[i].mUserData = i;
  JPH::MeshShapeSettings mesh(std::move(corners), std::move(triangles));
  mesh.mPerTriangleUserData = true;
  return mesh.Create();
}

}  // namespace

JPH::Shape::ShapeResult make_mesh(const PlumbShapeDesc& desc) {
  JPH::VertexList corners;
  JPH::IndexedTriangleList triangles;
  for (const double* v = desc.vertices; v != desc.vertices + 3 * std::size_t{desc.vertex_count}; v += 3)
    corners.push_back(corner({v[0], v[1], v[2]}, "a vertex"));
  for (std::size_t i = 0; i < desc.triangle_count; ++i)
    triangles.push_back({desc.indices[3 * i], desc.indices[3 * i + 1], desc.indices[3 * i + 2], 0});
  return make(std::move(corners), std::move(triangles));
}

JPH::Shape::ShapeResult make_height_field(const PlumbShapeDesc& desc) {
  JPH::VertexList corners;
  JPH::IndexedTriangleList triangles;
  const auto at = [&](std::uint32_t row, std::uint32_t column) { return row * desc.columns + column; };
  for (std::uint32_t r = 0; r < desc.rows; ++r)
    for (std::uint32_t c = 0; c < desc.columns; ++c)
      corners.push_back(corner({(c - (desc.columns - 1) / 2.0) * desc.spacing.x, desc.heights[at(r, c)],
                                (r - (desc.rows - 1) / 2.0) * desc.spacing.z},
                               "a height"));
  for (std::uint32_t r = 0; r + 1 < desc.rows; ++r)
    for (std::uint32_t c = 0; c + 1 < desc.columns; ++c) {
      triangles.push_back({at(r, c), at(r + 1, c), at(r, c + 1), 0});
      triangles.push_back({at(r, c + 1), at(r + 1, c), at(r + 1, c + 1), 0});
    }
  return make(std::move(corners), std::move(triangles));
}

}  // namespace plumb::jolt
