// All triangle meshes and height fields of a world, where kernels run.
#pragma once

#include <memory>
#include <vector>

#include "bvh/lbvh.hpp"
#include "exec/table.hpp"
#include "geometry/surface.hpp"
#include "geometry/surface_change.hpp"
#include "plumb/backend/cooking.hpp"
#include "plumb/shapes.h"

namespace plumb::impulse {

/// Rows are names that stay. A mesh has a tree of its triangles in its own frame, which is right wherever it moves.
class SurfacePool {
 public:
  /// Builds the tree on the executor and waits for it. Not within a step.
  AddedSurface add_mesh(Executor& executor, const PlumbShapeDesc& desc);
  AddedSurface add_field(const PlumbShapeDesc& desc);
  /// A mesh in bytes, the same wherever they are made; of no world, and on any thread that has the executor alone.
  [[nodiscard]] static std::vector<std::byte> cook_mesh(Executor& executor, const PlumbShapeDesc& desc);
  /// As add_mesh() of the description that was cooked. Throws Error PLUMB_E_CORRUPT for bytes that are of no mesh.
  AddedSurface add_cooked_mesh(backend::CookedReader& bytes);
  void remove_mesh(std::uint32_t row) { remove(meshes_, row); }
  void remove_field(std::uint32_t row) { remove(fields_, row); }

  /// The surface becomes that of the description, as if it was added. Not within a step. A mesh that is joined as
  /// before, and a height field of the same grid, cost less than new ones.
  ChangedSurface change_mesh(Executor& executor, std::uint32_t row, const PlumbShapeDesc& desc);
  ChangedSurface change_field(std::uint32_t row, const PlumbShapeDesc& desc);

  /// Of a shape that is one of them.
  [[nodiscard]] const LastChange& last_change(const Shape& shape) const {
    return shape.type == ShapeType::kMesh ? mesh_views_[shape.hull].change : field_views_[shape.hull].change;
  }
  void set_last_change(const Shape& shape, const LastChange& change) {
    (shape.type == ShapeType::kMesh ? mesh_views_.edit(shape.hull).change : field_views_.edit(shape.hull).change) =
        change;
  }

  /// What changed since the last upload goes to where kernels run. Not within a step.
  void upload(Executor& executor);
  /// To be asked for anew after an addition.
  [[nodiscard]] Surfaces device() { return {mesh_views_.device(), field_views_.device(), with_materials_}; }

 private:
  /// By triangle; empty where all are the body's.
  struct Materials {
    Buffer<Material> rows;
    Buffer<std::uint32_t> of;

    explicit Materials(const PlumbShapeDesc& desc);
    explicit Materials(backend::CookedReader& bytes);
    void cook(backend::CookedWriter& bytes) const;
    [[nodiscard]] bool is_of(const PlumbShapeDesc& desc) const;
    [[nodiscard]] TriangleMaterials view() const { return {rows.data(), of.data()}; }
  };
  struct Mesh {
    Table<Vec> corners;
    Table<MeshTriangle> triangles;
    Buffer<std::uint32_t> first_neighbour, neighbours;
    Buffer<TreeNode> nodes;
    Materials materials;
    std::vector<std::uint32_t> corner_of;  ///< by vertex
    AddedSurface added;
    bool closed;

    Mesh(Executor& executor, const PlumbShapeDesc& desc);
    explicit Mesh(backend::CookedReader& bytes);
    void cook(backend::CookedWriter& bytes) const;
    [[nodiscard]] bool move(Executor& executor, const PlumbShapeDesc& desc, Extent& where);
  };
  struct Field {
    Table<Real> heights;
    Materials materials;
    AddedSurface added;

    explicit Field(const PlumbShapeDesc& desc);
    void raise(const PlumbShapeDesc& desc, Extent& where);
  };

  template <class T>
  static std::uint32_t row_for(std::vector<std::unique_ptr<T>>& all, std::unique_ptr<T> one);
  template <class T>
  void remove(std::vector<std::unique_ptr<T>>& all, std::uint32_t row) {
    if (all[row]->materials.of.size() != 0) --with_materials_;
    all[row].reset();
  }
  AddedSurface add(std::unique_ptr<Mesh> mesh);
  template <class T>
  void replace(std::unique_ptr<T>& old, std::unique_ptr<T> other);
  void show_mesh(std::uint32_t row);
  void show_field(std::uint32_t row, const PlumbShapeDesc& desc);

  std::vector<std::unique_ptr<Mesh>> meshes_;  // by row; none where one was removed
  std::vector<std::unique_ptr<Field>> fields_;
  Table<MeshView> mesh_views_;
  Table<HeightView> field_views_;
  std::uint32_t with_materials_ = 0;
};

}  // namespace plumb::impulse
