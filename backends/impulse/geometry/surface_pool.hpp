// All triangle meshes and height fields of a world, where kernels run.
#pragma once

#include <memory>
#include <vector>

#include "bvh/lbvh.hpp"
#include "exec/table.hpp"
#include "geometry/surface.hpp"
#include "plumb/shapes.h"

namespace plumb::impulse {

/// A surface that was added: its row among those of its kind, and what its Shape tells.
struct AddedSurface {
  std::uint32_t row;
  PlumbVec3 centre;  ///< of its box in the frame of the description; the origin of the Shape's frame
  Vec half;
  Real reach;
};

/// Rows are names that stay. A mesh has a tree of its triangles in its own frame, which is right wherever it moves.
class SurfacePool {
 public:
  /// Builds the tree on the executor and waits for it. Not within a step.
  AddedSurface add_mesh(Executor& executor, const PlumbShapeDesc& desc);
  AddedSurface add_field(const PlumbShapeDesc& desc);
  void remove_mesh(std::uint32_t row) { remove(meshes_, row); }
  void remove_field(std::uint32_t row) { remove(fields_, row); }

  /// What changed since the last upload goes to where kernels run. Not within a step.
  void upload(Executor& executor) {
    mesh_views_.upload(executor);
    field_views_.upload(executor);
  }
  /// To be asked for anew after an addition.
  [[nodiscard]] Surfaces device() { return {mesh_views_.device(), field_views_.device(), with_materials_}; }

 private:
  /// By triangle; empty where all are the body's.
  struct Materials {
    Buffer<Material> rows;
    Buffer<std::uint32_t> of;
  };
  struct Mesh {
    Buffer<Vec> corners;
    Buffer<MeshTriangle> triangles;
    Buffer<std::uint32_t> first_neighbour, neighbours;
    Buffer<TreeNode> nodes;
    Materials materials;
  };
  struct Field {
    Buffer<Real> heights;
    Materials materials;
  };

  template <class T>
  static std::uint32_t add(std::vector<std::unique_ptr<T>>& all, std::unique_ptr<T> one);
  template <class T>
  void remove(std::vector<std::unique_ptr<T>>& all, std::uint32_t row) {
    if (all[row]->materials.of.size() != 0) --with_materials_;
    all[row].reset();
  }
  [[nodiscard]] TriangleMaterials add_materials(const PlumbShapeDesc& desc, std::size_t triangles,
                                                Materials& materials);

  std::vector<std::unique_ptr<Mesh>> meshes_;  // by row; none where one was removed
  std::vector<std::unique_ptr<Field>> fields_;
  Table<MeshView> mesh_views_;
  Table<HeightView> field_views_;
  std::uint32_t with_materials_ = 0;
};

}  // namespace plumb::impulse
