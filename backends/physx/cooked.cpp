// Hulls, meshes and height fields: what PhysX cooks.
#include <algorithm>

#include "device.hpp"
#include "plumb/backend/names.hpp"
#include "shapes.hpp"
#include "start.hpp"

namespace plumb::px {
namespace {

/// m: of a hull, points this near to a face lie in it. PhysX's own .7 mm is taken where it makes no hull with this.
constexpr float kPlaneTolerance = 1e-5f;
/// Height fields count materials by seven bits, and one of their numbers is a hole.
constexpr std::size_t kMostFieldMaterials = 127;
constexpr double kMostSample = 32767;

PxCookingParams how_to_cook() {
  PxCookingParams params(physics().getTolerancesScale());
  params.buildGPUData = kOnGpu;
  return params;
}

std::vector<PxVec3> vertices_of(const PlumbShapeDesc& desc) {
  std::vector<PxVec3> vertices;
  vertices.reserve(desc.vertex_count);
  for (std::size_t i = 0; i < desc.vertex_count; ++i) vertices.push_back(vector(desc.vertices + 3 * i, "a vertex"));
  return vertices;
}

[[noreturn]] void refuse_shape(PlumbShapeType type) {
  throw Error(PLUMB_E_UNSUPPORTED, std::string("PhysX makes no such ") + backend::shape_name(type) + because());
}

PxConvexMesh* cook_hull(const PxConvexMeshDesc& desc, float tolerance) {
  PxCookingParams params = how_to_cook();
  params.planeTolerance = tolerance;
  (void)complaint();
  return PxCreateConvexMesh(params, desc);
}

/// Which row of a table of materials a triangle has: 0 is the body's.
std::size_t row_of(const PlumbShapeDesc& desc, std::size_t triangle) {
  if (desc.material_count == 0 || desc.triangle_materials == nullptr) return 0;
  const std::uint32_t row = desc.triangle_materials[triangle];
  return row == PLUMB_BODY_MATERIAL ? 0 : std::size_t{row} + 1;
}

void keep_materials(const PlumbShapeDesc& desc, std::size_t most, Shape& shape) {
  if (shape.triangles.empty()) return;
  if (desc.material_count >= most)
    throw Error(PLUMB_E_UNSUPPORTED, "material_count is " + std::to_string(desc.material_count) + "; PhysX's " +
                                         backend::shape_name(desc.type) + "s have at most " + std::to_string(most - 1));
  shape.materials.assign(desc.materials, desc.materials + desc.material_count);
}

/// The heights as PhysX's whole numbers.
struct Quantized {
  explicit Quantized(const PlumbShapeDesc& desc) {
    const auto [least, most] = std::minmax_element(desc.heights, desc.heights + std::size_t{desc.rows} * desc.columns);
    middle = 0.5 * *least + 0.5 * *most;
    unit = std::max(0.5 * *most - 0.5 * *least, 1e-6) / kMostSample;
    if (unit < static_cast<double>(PX_MIN_HEIGHTFIELD_Y_SCALE)) unit = static_cast<double>(PX_MIN_HEIGHTFIELD_Y_SCALE);
  }
  [[nodiscard]] PxI16 sample(double height) const {
    return static_cast<PxI16>(std::clamp(std::nearbyint((height - middle) / unit), -kMostSample, kMostSample));
  }

  double middle, unit;  ///< m
};

}  // namespace

void make_hull(const PlumbShapeDesc& desc, Shape& shape) {
  const std::vector<PxVec3> vertices = vertices_of(desc);
  PxConvexMeshDesc hull;
  hull.points.count = desc.vertex_count;
  hull.points.stride = sizeof(PxVec3);
  hull.points.data = vertices.data();
  if (kOnGpu) hull.vertexLimit = hull.polygonLimit = 64;
  hull.flags = PxConvexFlag::eCOMPUTE_CONVEX | PxConvexFlag::eSHIFT_VERTICES;
  PxConvexMesh* made = cook_hull(hull, kPlaneTolerance);
  if (made == nullptr) made = cook_hull(hull, how_to_cook().planeTolerance);
  if (made == nullptr) refuse_shape(desc.type);
  shape.cooked = made;
  Piece piece;
  piece.geometry.storeAny(PxConvexMeshGeometry(made, PxMeshScale(), PxConvexMeshGeometryFlags()));
  shape.pieces.push_back(piece);
}

void make_mesh(const PlumbShapeDesc& desc, Shape& shape) {
  keep_materials(desc, 65535, shape);
  const std::vector<PxVec3> vertices = vertices_of(desc);
  std::vector<PxMaterialTableIndex> rows;
  for (std::size_t i = 0; !shape.triangles.empty() && i < desc.triangle_count; ++i)
    rows.push_back(static_cast<PxMaterialTableIndex>(row_of(desc, i)));
  PxTriangleMeshDesc mesh;
  mesh.points.count = desc.vertex_count;
  mesh.points.stride = sizeof(PxVec3);
  mesh.points.data = vertices.data();
  mesh.triangles.count = desc.triangle_count;
  mesh.triangles.stride = 3 * sizeof(PxU32);
  mesh.triangles.data = desc.indices;
  if (!rows.empty()) {
    mesh.materialIndices.data = rows.data();
    mesh.materialIndices.stride = sizeof(PxMaterialTableIndex);
  }
  (void)complaint();
  PxTriangleMesh* made = PxCreateTriangleMesh(how_to_cook(), mesh);
  if (made == nullptr) refuse_shape(desc.type);
  shape.cooked = made;
  Piece piece;
  piece.geometry.storeAny(PxTriangleMeshGeometry(made));
  shape.pieces.push_back(piece);
}

/// PhysX's rows lie along x, so its rows are our columns. Its diagonals run as ours where no flag is set.
void make_height_field(const PlumbShapeDesc& desc, Shape& shape) {
  keep_materials(desc, kMostFieldMaterials, shape);
  const Quantized quantized(desc);
  std::vector<PxHeightFieldSample> samples(std::size_t{desc.rows} * desc.columns);
  const auto index = [&](std::uint32_t row, std::uint32_t column) { return std::size_t{column} * desc.rows + row; };
  for (std::uint32_t r = 0; r < desc.rows; ++r)
    for (std::uint32_t c = 0; c < desc.columns; ++c) {
      PxHeightFieldSample& sample = samples[index(r, c)];
      sample.height = quantized.sample(desc.heights[std::size_t{r} * desc.columns + c]);
      sample.materialIndex0 = sample.materialIndex1 = 0;
      if (shape.triangles.empty() || r + 1 == desc.rows || c + 1 == desc.columns) continue;
      const std::size_t triangle = 2 * (std::size_t{r} * (desc.columns - 1) + c);
      sample.materialIndex0 = static_cast<PxU8>(row_of(desc, triangle));
      sample.materialIndex1 = static_cast<PxU8>(row_of(desc, triangle + 1));
    }
  PxHeightFieldDesc field;
  field.nbRows = desc.columns;
  field.nbColumns = desc.rows;
  field.samples.data = samples.data();
  field.samples.stride = sizeof(PxHeightFieldSample);
  (void)complaint();
  PxHeightField* made = PxCreateHeightField(field);
  if (made == nullptr) refuse_shape(desc.type);
  shape.cooked = made;
  const float x = scalar(desc.spacing.x, "spacing.x"), z = scalar(desc.spacing.z, "spacing.z");
  Piece piece;
  piece.geometry.storeAny(PxHeightFieldGeometry(made, PxMeshGeometryFlags(), static_cast<float>(quantized.unit), x, z));
  piece.at.p = vector(
      PlumbVec3{-0.5 * (desc.columns - 1) * desc.spacing.x, quantized.middle, -0.5 * (desc.rows - 1) * desc.spacing.z},
      "a corner of the field");
  shape.pieces.push_back(piece);
}

}  // namespace plumb::px
