#include "geometry/surface_pool.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geometry/mesh_topology.hpp"

namespace plumb::impulse {

namespace {

/// The nodes of a tree over the boxes.
Buffer<TreeNode> build_tree(Executor& executor, const std::vector<Box>& boxes) {
  const auto count = static_cast<std::uint32_t>(boxes.size());
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  Buffer<Box> leaves;
  Buffer<std::uint32_t> order;
  leaves.assign(boxes);
  order.assign(all);
  Buffer<SceneExtent> extent(1);
  Reduce<SceneExtent> reduce;
  reduce.reserve(count);
  reduce.run(executor, count, LoadExtent{leaves.data(), order.data()}, extent.data());
  Lbvh tree;
  tree.reserve(count);
  tree.build(executor, leaves.data(), order.data(), count, extent.data());
  executor.wait();
  return tree.take_nodes();
}

}  // namespace

template <class T>
std::uint32_t SurfacePool::add(std::vector<std::unique_ptr<T>>& all, std::unique_ptr<T> one) {
  const auto room = std::find(all.begin(), all.end(), nullptr);
  const auto row = static_cast<std::uint32_t>(room - all.begin());
  if (room == all.end()) all.emplace_back();
  all[row] = std::move(one);
  return row;
}

TriangleMaterials SurfacePool::add_materials(const PlumbShapeDesc& desc, std::size_t triangles, Materials& materials) {
  if (desc.material_count == 0) return {};
  std::vector<Material> rows;
  for (const PlumbMaterial& given : std::span(desc.materials, desc.material_count))
    rows.push_back({static_cast<Real>(given.friction), static_cast<Real>(given.restitution)});
  materials.rows.assign(rows);
  materials.of.assign(std::vector<std::uint32_t>(desc.triangle_materials, desc.triangle_materials + triangles));
  ++with_materials_;
  return {materials.rows.data(), materials.of.data()};
}

AddedSurface SurfacePool::add_mesh(Executor& executor, const PlumbShapeDesc& desc) {
  const MeshTopology topology(executor, {reinterpret_cast<const PlumbVec3*>(desc.vertices), desc.vertex_count},
                              {desc.indices, std::size_t{3} * desc.triangle_count});
  auto mesh = std::make_unique<Mesh>();
  mesh->corners.assign(topology.corners);
  mesh->triangles.assign(topology.triangles);
  mesh->first_neighbour.assign(topology.first_neighbour);
  mesh->neighbours.assign(topology.neighbours);
  mesh->nodes = build_tree(executor, topology.boxes);
  const MeshView view = {mesh->corners.data(),
                         mesh->triangles.data(),
                         mesh->first_neighbour.data(),
                         mesh->neighbours.data(),
                         {mesh->nodes.data(), desc.triangle_count},
                         topology.closed ? 1U : 0U,
                         add_materials(desc, desc.triangle_count, mesh->materials)};
  const std::uint32_t row = add(meshes_, std::move(mesh));
  if (row >= mesh_views_.size()) mesh_views_.grow(row + row / 2 + 1);
  mesh_views_.edit(row) = view;
  return {row, topology.centre, topology.half, topology.reach};
}

AddedSurface SurfacePool::add_field(const PlumbShapeDesc& desc) {
  const std::size_t count = std::size_t{desc.rows} * desc.columns;
  const auto [low, high] = std::minmax_element(desc.heights, desc.heights + count);
  const double middle = 0.5 * (*low + *high);
  const double width = 0.5 * (desc.columns - 1) * desc.spacing.x, depth = 0.5 * (desc.rows - 1) * desc.spacing.z;
  std::vector<Real> heights(count);
  for (std::size_t i = 0; i < count; ++i) heights[i] = static_cast<Real>(desc.heights[i] - middle);
  auto field = std::make_unique<Field>();
  field->heights.assign(heights);
  const std::size_t triangles = std::size_t{2} * (desc.rows - 1) * (desc.columns - 1);
  const HeightView view = {field->heights.data(),
                           desc.rows,
                           desc.columns,
                           static_cast<Real>(desc.spacing.x),
                           static_cast<Real>(desc.spacing.z),
                           static_cast<Real>(-width),
                           static_cast<Real>(-depth),
                           add_materials(desc, triangles, field->materials)};
  const std::uint32_t row = add(fields_, std::move(field));
  if (row >= field_views_.size()) field_views_.grow(row + row / 2 + 1);
  field_views_.edit(row) = view;
  const double height = 0.5 * (*high - *low);
  const double reach = std::sqrt(width * width + depth * depth + height * height);
  return {row,
          {0, middle, 0},
          {static_cast<Real>(width), static_cast<Real>(height), static_cast<Real>(depth)},
          static_cast<Real>(reach)};
}

}  // namespace plumb::impulse
