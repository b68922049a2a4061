#include "cooking/cooked_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "cooking/mesh_tree.hpp"

namespace plumb::bullet {
namespace {

using backend::CookedReader;

/// Of numbers alone, without padding.
struct MeshCounts {
  std::uint32_t vertices, triangles, materials, is_quantized;
};
struct MeshBox {
  btScalar low[3], high[3];
};

bool is_material(const PlumbMaterial& material) {
  return std::isfinite(material.friction) && material.friction >= 0 && material.restitution >= 0 &&
         material.restitution <= 1;
}

/// Of the arrays that it points to, which are copied.
backend::TriangleMaterials materials_of(std::span<const PlumbMaterial> rows, std::span<const std::uint32_t> of) {
  PlumbShapeDesc desc = shape_desc(PLUMB_TRIANGLE_MESH);
  desc.materials = rows.data();
  desc.material_count = static_cast<std::uint32_t>(rows.size());
  desc.triangle_materials = of.data();
  desc.triangle_count = static_cast<std::uint32_t>(of.size());
  return backend::TriangleMaterials(desc);
}

}  // namespace

std::vector<std::byte> cook_mesh(const PlumbShapeDesc& desc) {
  Shape shape;
  take_triangles(desc, shape);
  const bool has_materials = backend::has_triangle_materials(desc);
  const MeshCounts counts = {desc.vertex_count, desc.triangle_count, has_materials ? desc.material_count : 0,
                             desc.triangle_count < kQuantizedTriangles ? 1U : 0U};
  const btBvhTriangleMeshShape unsearched(shape.mesh.get(), counts.is_quantized != 0, false);
  const btVector3 &low = unsearched.getLocalAabbMin(), &high = unsearched.getLocalAabbMax();
  backend::CookedWriter out;
  out.value(counts);
  out.value(MeshBox{{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}});
  out.items(shape.vertices.data(), shape.vertices.size());
  out.items(shape.indices.data(), shape.indices.size());
  if (has_materials) {
    out.items(desc.materials, desc.material_count);
    out.items(desc.triangle_materials, desc.triangle_count);
  }
  if (counts.is_quantized != 0) MeshTree(*shape.mesh, low, high).cook(out);
  return out.take();
}

std::shared_ptr<const Shape> make_cooked_mesh(std::span<const std::byte> bytes) {
  CookedReader in(bytes);
  const auto counts = in.value<MeshCounts>();
  const auto box = in.value<MeshBox>();
  auto shape = std::make_shared<Shape>();
  shape->type = PLUMB_TRIANGLE_MESH;
  shape->vertices = in.list<btScalar>(std::uint64_t{3} * counts.vertices);
  shape->indices = in.list<int>(std::uint64_t{3} * counts.triangles);
  const auto materials = in.list<PlumbMaterial>(counts.materials);
  const auto of = in.list<std::uint32_t>(counts.materials == 0 ? 0 : counts.triangles);
  const auto is_finite = [](btScalar x) { return std::isfinite(x); };
  const bool sound =
      counts.vertices != 0 && counts.triangles != 0 &&
      (counts.is_quantized == 1) == (counts.triangles < kQuantizedTriangles) && counts.is_quantized <= 1 &&
      std::all_of(shape->vertices.begin(), shape->vertices.end(), is_finite) &&
      std::all_of(std::begin(box.low), std::end(box.low), is_finite) &&
      std::all_of(std::begin(box.high), std::end(box.high), is_finite) &&
      std::all_of(shape->indices.begin(), shape->indices.end(),
                  [&](int vertex) { return static_cast<std::uint32_t>(vertex) < counts.vertices; }) &&
      std::all_of(materials.begin(), materials.end(), is_material) &&
      std::all_of(of.begin(), of.end(),
                  [&](std::uint32_t row) { return row < counts.materials || row == PLUMB_BODY_MATERIAL; });
  if (!sound) CookedReader::corrupt("is of no mesh");
  shape->materials = materials_of(materials, of);
  index_triangles(*shape);
  shape->mesh->setPremadeAabb(btVector3(box.low[0], box.low[1], box.low[2]),
                              btVector3(box.high[0], box.high[1], box.high[2]));
  const bool has_tree = counts.is_quantized != 0;
  if (has_tree) shape->tree = std::make_unique<MeshTree>(in, counts.triangles);
  in.finish();
  auto mesh = std::make_unique<btBvhTriangleMeshShape>(shape->mesh.get(), has_tree, !has_tree);
  if (has_tree) mesh->setOptimizedBvh(shape->tree.get());
  shape->bullet = std::move(mesh);
  return shape;
}

}  // namespace plumb::bullet
