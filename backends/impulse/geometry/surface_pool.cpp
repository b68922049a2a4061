#include "geometry/surface_pool.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geometry/mesh_topology.hpp"
#include "plumb/backend/check_descs.hpp"

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

/// Height fields are as high above the middle of their heights as they are deep below it.
AddedSurface frame_of_field(const PlumbShapeDesc& desc) {
  const auto [low, high] = std::minmax_element(desc.heights, desc.heights + std::size_t{desc.rows} * desc.columns);
  const double middle = 0.5 * (*low + *high), height = 0.5 * (*high - *low);
  const double width = 0.5 * (desc.columns - 1) * desc.spacing.x, depth = 0.5 * (desc.rows - 1) * desc.spacing.z;
  return {0,
          {0, middle, 0},
          {static_cast<Real>(width), static_cast<Real>(height), static_cast<Real>(depth)},
          static_cast<Real>(std::sqrt(width * width + depth * depth + height * height))};
}

HeightView grid_of(const PlumbShapeDesc& desc) {
  HeightView view{};
  view.rows = desc.rows;
  view.columns = desc.columns;
  view.spacing_x = static_cast<Real>(desc.spacing.x);
  view.spacing_z = static_cast<Real>(desc.spacing.z);
  view.x0 = static_cast<Real>(-0.5 * (desc.columns - 1) * desc.spacing.x);
  view.z0 = static_cast<Real>(-0.5 * (desc.rows - 1) * desc.spacing.z);
  return view;
}

bool same_grid(const HeightView& a, const HeightView& b) {
  return a.rows == b.rows && a.columns == b.columns && a.spacing_x == b.spacing_x && a.spacing_z == b.spacing_z &&
         a.x0 == b.x0 && a.z0 == b.z0;
}

std::span<const PlumbVec3> vertices_of(const PlumbShapeDesc& desc) {
  return {reinterpret_cast<const PlumbVec3*>(desc.vertices), desc.vertex_count};
}

/// A point of a Shape's frame in that of the description.
PlumbVec3 in_description(const AddedSurface& added, const Vec& at) {
  return {added.centre.x + static_cast<double>(at.x), added.centre.y + static_cast<double>(at.y),
          added.centre.z + static_cast<double>(at.z)};
}

template <class T>
void fill(Table<T>& table, const std::vector<T>& rows) {
  table.grow(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) table.edit(i) = rows[i];
}

}  // namespace

template <class T>
std::uint32_t SurfacePool::row_for(std::vector<std::unique_ptr<T>>& all, std::unique_ptr<T> one) {
  const auto room = std::find(all.begin(), all.end(), nullptr);
  const auto row = static_cast<std::uint32_t>(room - all.begin());
  if (room == all.end()) all.emplace_back();
  all[row] = std::move(one);
  all[row]->added.row = row;
  return row;
}

SurfacePool::Materials::Materials(const PlumbShapeDesc& desc) {
  if (!backend::has_triangle_materials(desc)) return;
  std::vector<Material> given;
  for (const PlumbMaterial& material : std::span(desc.materials, desc.material_count))
    given.push_back({static_cast<Real>(material.friction), static_cast<Real>(material.restitution)});
  rows.assign(given);
  of.assign({desc.triangle_materials, desc.triangle_materials + backend::triangles_of(desc)});
}

bool SurfacePool::Materials::is_of(const PlumbShapeDesc& desc) const {
  if (!backend::has_triangle_materials(desc)) return of.size() == 0;
  const std::span given(desc.triangle_materials, backend::triangles_of(desc));
  if (of.size() != given.size() || rows.size() != desc.material_count) return false;
  const std::vector<Material> now = rows.to_host(rows.size());
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i].friction != static_cast<Real>(desc.materials[i].friction) ||
        now[i].restitution != static_cast<Real>(desc.materials[i].restitution))
      return false;
  const std::vector<std::uint32_t> rows_now = of.to_host(of.size());
  return std::equal(rows_now.begin(), rows_now.end(), given.begin());
}

SurfacePool::Mesh::Mesh(Executor& executor, const PlumbShapeDesc& desc) : materials(desc) {
  MeshTopology topology(executor, vertices_of(desc), {desc.indices, std::size_t{3} * desc.triangle_count});
  fill(corners, topology.places.corners);
  fill(triangles, topology.triangles);
  first_neighbour.assign(topology.first_neighbour);
  neighbours.assign(topology.neighbours);
  nodes = build_tree(executor, topology.boxes);
  corner_of = std::move(topology.corner_of);
  closed = topology.closed;
  added = {0, topology.places.centre, topology.places.half, topology.places.reach};
}

SurfacePool::Field::Field(const PlumbShapeDesc& desc) : materials(desc), added(frame_of_field(desc)) {
  const std::size_t count = std::size_t{desc.rows} * desc.columns;
  heights.grow(count);
  for (std::size_t i = 0; i < count; ++i) heights.edit(i) = static_cast<Real>(desc.heights[i] - added.centre.y);
}

void SurfacePool::show_mesh(std::uint32_t row) {
  Mesh& mesh = *meshes_[row];
  if (row >= mesh_views_.size()) mesh_views_.grow(row + row / 2 + 1);
  mesh_views_.edit(row) = {mesh.corners.device(),
                           mesh.triangles.device(),
                           mesh.first_neighbour.data(),
                           mesh.neighbours.data(),
                           {mesh.nodes.data(), static_cast<std::uint32_t>(mesh.triangles.size())},
                           mesh.closed ? 1U : 0U,
                           mesh.materials.view()};
}

void SurfacePool::show_field(std::uint32_t row, const PlumbShapeDesc& desc) {
  Field& field = *fields_[row];
  if (row >= field_views_.size()) field_views_.grow(row + row / 2 + 1);
  HeightView& view = field_views_.edit(row);
  view = grid_of(desc);
  view.heights = field.heights.device();
  view.materials = field.materials.view();
}

AddedSurface SurfacePool::add_mesh(Executor& executor, const PlumbShapeDesc& desc) {
  return add(std::make_unique<Mesh>(executor, desc));
}

AddedSurface SurfacePool::add(std::unique_ptr<Mesh> mesh) {
  const std::uint32_t row = row_for(meshes_, std::move(mesh));
  if (meshes_[row]->materials.of.size() != 0) ++with_materials_;
  show_mesh(row);
  return meshes_[row]->added;
}

AddedSurface SurfacePool::add_field(const PlumbShapeDesc& desc) {
  const std::uint32_t row = row_for(fields_, std::make_unique<Field>(desc));
  if (fields_[row]->materials.of.size() != 0) ++with_materials_;
  show_field(row, desc);
  return fields_[row]->added;
}

/// Puts another in its place.
template <class T>
void SurfacePool::replace(std::unique_ptr<T>& old, std::unique_ptr<T> other) {
  if (old->materials.of.size() != 0) --with_materials_;
  if (other->materials.of.size() != 0) ++with_materials_;
  other->added.row = old->added.row;
  old = std::move(other);
}

ChangedSurface SurfacePool::change_mesh(Executor& executor, std::uint32_t row, const PlumbShapeDesc& desc) {
  std::unique_ptr<Mesh>& mesh = meshes_[row];
  const AddedSurface before = mesh->added;
  Extent where;
  if (!mesh->materials.is_of(desc) || !mesh->move(executor, desc, where)) {
    replace(mesh, std::make_unique<Mesh>(executor, desc));
    where.add(before);
    where.add(mesh->added);
  }
  const bool frame_is_other = !same_place(before.centre, mesh->added.centre);
  if (frame_is_other || !where.is_empty()) show_mesh(row);
  return {mesh->added, where, frame_is_other};
}

ChangedSurface SurfacePool::change_field(std::uint32_t row, const PlumbShapeDesc& desc) {
  std::unique_ptr<Field>& field = fields_[row];
  const AddedSurface before = field->added;
  Extent where;
  if (field->materials.is_of(desc) && same_grid(field_views_[row], grid_of(desc))) {
    field->raise(desc, where);
  } else {
    replace(field, std::make_unique<Field>(desc));
    show_field(row, desc);
    where.add(before);
    where.add(field->added);
  }
  return {field->added, where, !same_place(before.centre, field->added.centre)};
}

/// Vertices elsewhere, joined as before. False, and nothing is done, where triangles join others than before, or have
/// an area that had none, or none that had one.
bool SurfacePool::Mesh::move(Executor& executor, const PlumbShapeDesc& desc, Extent& where) {
  const std::span<const PlumbVec3> vertices = vertices_of(desc);
  if (vertices.size() != corner_of.size() || desc.triangle_count != triangles.size()) return false;
  for (std::size_t i = 0; i < std::size_t{3} * desc.triangle_count; ++i)
    if (triangles[i / 3].corner[i % 3] != corner_of[desc.indices[i]]) return false;
  const MeshPlaces places = place_corners(vertices, corner_of);
  if (!places.joined) return false;
  const AddedSurface now = {added.row, places.centre, places.half, places.reach};
  const bool same_frame = same_place(now.centre, added.centre);
  const double rounding = static_cast<double>(kEpsilon) * static_cast<double>(added.reach);
  std::vector<bool> moved(places.corners.size());
  for (std::size_t c = 0; c < moved.size(); ++c) {
    const PlumbVec3 then = in_description(added, corners[c]), here = in_description(now, places.corners[c]);
    const double way = std::max({std::abs(here.x - then.x), std::abs(here.y - then.y), std::abs(here.z - then.z)});
    moved[c] = way > (same_frame ? 0 : rounding);
  }
  std::vector<Box> boxes(triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    const MeshTriangle& triangle = triangles[t];
    const Box was = box_of(triangle, &corners[0]);
    boxes[t] = box_of(triangle, places.corners.data());
    const bool has_area = was.low.x <= was.high.x;
    if (has_area != (boxes[t].low.x <= boxes[t].high.x)) return false;
    if (!has_area) continue;
    if (!moved[triangle.corner[0]] && !moved[triangle.corner[1]] && !moved[triangle.corner[2]]) continue;
    for (const Vec& at : {was.low, was.high}) where.add(in_description(added, at));
    for (const Vec& at : {boxes[t].low, boxes[t].high}) where.add(in_description(now, at));
  }
  if (where.is_empty() && same_frame) return true;
  nodes = build_tree(executor, boxes);
  for (std::size_t c = 0; c < moved.size(); ++c)
    if (!same_frame || moved[c]) corners.edit(c) = places.corners[c];
  added = now;
  return true;
}

/// Other heights on the same grid.
void SurfacePool::Field::raise(const PlumbShapeDesc& desc, Extent& where) {
  AddedSurface now = frame_of_field(desc);
  now.row = added.row;
  const bool same_frame = same_place(now.centre, added.centre);
  const double rounding = same_frame ? 0 : static_cast<double>(kEpsilon) * static_cast<double>(added.half.y);
  const double x0 = -0.5 * (desc.columns - 1) * desc.spacing.x, z0 = -0.5 * (desc.rows - 1) * desc.spacing.z;
  std::vector<Real> relative(desc.columns);
  for (std::uint32_t row = 0; row < desc.rows; ++row) {
    const std::size_t first = std::size_t{row} * desc.columns;
    for (std::size_t c = 0; c < relative.size(); ++c)
      relative[c] = static_cast<Real>(desc.heights[first + c] - now.centre.y);
    if (std::equal(relative.begin(), relative.end(), &heights[first])) continue;
    for (std::size_t c = 0; c < relative.size(); ++c) {
      if (relative[c] == heights[first + c]) continue;
      const double height = desc.heights[first + c], then = added.centre.y + static_cast<double>(heights[first + c]);
      heights.edit(first + c) = relative[c];
      if (std::abs(height - then) <= rounding) continue;
      const auto column = static_cast<double>(c);
      where.add(
          PlumbVec3{x0 + (column - 1) * desc.spacing.x, std::min(height, then), z0 + (row - 1.0) * desc.spacing.z});
      where.add(
          PlumbVec3{x0 + (column + 1) * desc.spacing.x, std::max(height, then), z0 + (row + 1.0) * desc.spacing.z});
    }
  }
  added = now;
}

void SurfacePool::upload(Executor& executor) {
  for (const auto& mesh : meshes_) {
    if (mesh == nullptr) continue;
    mesh->corners.upload(executor);
    mesh->triangles.upload(executor);
  }
  for (const auto& field : fields_)
    if (field != nullptr) field->heights.upload(executor);
  mesh_views_.upload(executor);
  field_views_.upload(executor);
}

}  // namespace plumb::impulse
