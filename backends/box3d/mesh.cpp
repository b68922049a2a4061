// Triangle meshes, and height fields as meshes: Box3D's own height fields are rounded to 16 bits.
#include <algorithm>
#include <array>
#include <map>

#include "plumb/backend/check_descs.hpp"
#include "shapes.hpp"

namespace plumb::box3d {
namespace {

using Corners = std::array<std::int32_t, 3>;

/// The same whichever corner comes first.
Corners turned(Corners corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// Box3D sorts triangles and drops those without an area: who is who is found by their corners.
std::vector<std::uint32_t> numbers_of(const b3MeshData& mesh, const std::vector<std::int32_t>& indices) {
  std::map<Corners, std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < indices.size() / 3; ++i)
    numbers.emplace(turned({indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]}), i);
  std::vector<std::uint32_t> found;
  const b3MeshTriangle* triangles = b3GetMeshTriangles(&mesh);
  for (int i = 0; i < mesh.triangleCount; ++i)
    found.push_back(numbers.at(turned({triangles[i].index1, triangles[i].index2, triangles[i].index3})));
  return found;
}

/// For each triangle its row of the materials that attach_shapes() gives, of which the first is the body's.
std::vector<std::uint8_t> take_materials(Shape& shape, const PlumbShapeDesc& desc) {
  constexpr std::uint32_t most = 255;  // beside the body's, in Box3D's byte a triangle
  if (!backend::has_triangle_materials(desc)) return {};
  if (desc.material_count > most)
    throw Error(PLUMB_E_UNSUPPORTED, "material_count is " + std::to_string(desc.material_count) +
                                         "; a mesh of Box3D holds " + std::to_string(most));
  shape.materials.assign(desc.materials, desc.materials + desc.material_count);
  std::vector<std::uint8_t> rows;
  for (std::size_t t = 0; t < backend::triangles_of(desc); ++t)
    rows.push_back(static_cast<std::uint8_t>(desc.triangle_materials[t] + 1));  // PLUMB_BODY_MATERIAL + 1 is 0
  return rows;
}

void make(Shape& shape, const PlumbShapeDesc& desc, std::vector<b3Vec3> points, std::vector<std::int32_t> indices) {
  std::vector<std::uint8_t> materials = take_materials(shape, desc);
  b3MeshDef def{};
  def.vertices = points.data();
  def.vertexCount = static_cast<int>(points.size());
  def.indices = indices.data();
  def.triangleCount = static_cast<int>(indices.size() / 3);
  def.materialIndices = materials.empty() ? nullptr : materials.data();
  def.identifyEdges = true;
  shape.mesh.reset(b3CreateMesh(&def, nullptr, 0));
  if (!shape.mesh)
    throw Error(PLUMB_E_INVALID_ARGUMENT, "Box3D makes no mesh of these " + std::to_string(def.triangleCount) +
                                              " triangles; do any of them have an area?");
  shape.triangles = numbers_of(*shape.mesh, indices);
}

}  // namespace

void make_mesh(Shape& shape, const PlumbShapeDesc& desc) {
  std::vector<b3Vec3> points;
  for (std::uint32_t i = 0; i < desc.vertex_count; ++i) points.push_back(vector(desc.vertices + 3 * i, "a vertex"));
  make(shape, desc, std::move(points), {desc.indices, desc.indices + 3 * std::size_t{desc.triangle_count}});
}

void make_height_field(Shape& shape, const PlumbShapeDesc& desc) {
  std::vector<b3Vec3> points;
  for (std::uint32_t r = 0; r < desc.rows; ++r)
    for (std::uint32_t c = 0; c < desc.columns; ++c)
      points.push_back(vector({(c - (desc.columns - 1) / 2.0) * desc.spacing.x, desc.heights[r * desc.columns + c],
                               (r - (desc.rows - 1) / 2.0) * desc.spacing.z},
                              "a height"));
  std::vector<std::int32_t> indices;
  const auto at = [&](std::uint32_t r, std::uint32_t c) { return static_cast<std::int32_t>(r * desc.columns + c); };
  for (std::uint32_t r = 0; r + 1 < desc.rows; ++r)
    for (std::uint32_t c = 0; c + 1 < desc.columns; ++c)
      indices.insert(indices.end(),
                     {at(r, c), at(r + 1, c), at(r, c + 1), at(r, c + 1), at(r + 1, c), at(r + 1, c + 1)});
  make(shape, desc, std::move(points), std::move(indices));
}

}  // namespace plumb::box3d
