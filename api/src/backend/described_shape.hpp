// A shape's descriptor in bytes: what is cooked of shapes that the engine itself adds nothing to.
#pragma once

#include "plumb/backend/check_descs.hpp"
#include "plumb/backend/cooking.hpp"

namespace plumb::backend {

/// desc: as check_shape() passes it, but no compound. What its type does not read is left out, whatever it is.
inline std::vector<std::byte> describe(const PlumbShapeDesc& desc) {
  CookedWriter out;
  switch (desc.type) {
    case PLUMB_SPHERE: out.value(desc.radius); break;
    case PLUMB_BOX: out.value(desc.half_extents); break;
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER:
      out.value(desc.radius);
      out.value(desc.half_height);
      break;
    case PLUMB_CONVEX_HULL:
    case PLUMB_TRIANGLE_MESH:
      out.value(desc.vertex_count);
      out.value(desc.type == PLUMB_TRIANGLE_MESH ? desc.triangle_count : 0U);
      out.items(desc.vertices, std::size_t{3} * desc.vertex_count);
      if (desc.type == PLUMB_TRIANGLE_MESH) out.items(desc.indices, std::size_t{3} * desc.triangle_count);
      break;
    case PLUMB_HEIGHT_FIELD:
      out.value(desc.rows);
      out.value(desc.columns);
      out.value(desc.spacing.x);
      out.value(desc.spacing.z);
      out.items(desc.heights, std::size_t{desc.rows} * desc.columns);
      break;
    default: break;
  }
  const bool has_materials = has_triangle_materials(desc);
  out.value(has_materials ? desc.material_count : 0U);
  if (!has_materials) return out.take();
  out.items(desc.materials, desc.material_count);
  out.items(desc.triangle_materials, triangles_of(desc));
  return out.take();
}

/// A descriptor that has its arrays itself. It has still to pass check_shape(). Throws PLUMB_E_CORRUPT.
class DescribedShape {
 public:
  DescribedShape(PlumbShapeType type, std::span<const std::byte> bytes) : desc_(shape_desc(type)) {
    CookedReader in(bytes);
    switch (type) {
      case PLUMB_SPHERE: desc_.radius = in.value<double>(); break;
      case PLUMB_BOX: desc_.half_extents = in.value<PlumbVec3>(); break;
      case PLUMB_CAPSULE:
      case PLUMB_CYLINDER:
        desc_.radius = in.value<double>();
        desc_.half_height = in.value<double>();
        break;
      case PLUMB_CONVEX_HULL:
      case PLUMB_TRIANGLE_MESH:
        desc_.vertex_count = in.value<std::uint32_t>();
        desc_.triangle_count = in.value<std::uint32_t>();
        numbers_ = in.list<double>(std::uint64_t{3} * desc_.vertex_count);
        indices_ = in.list<std::uint32_t>(std::uint64_t{3} * desc_.triangle_count);
        break;
      case PLUMB_HEIGHT_FIELD:
        desc_.rows = in.value<std::uint32_t>();
        desc_.columns = in.value<std::uint32_t>();
        desc_.spacing.x = in.value<double>();
        desc_.spacing.z = in.value<double>();
        numbers_ = in.list<double>(std::uint64_t{desc_.rows} * desc_.columns);
        break;
      default: break;
    }
    desc_.material_count = in.value<std::uint32_t>();
    if (has_triangle_materials(desc_)) {
      materials_ = in.list<PlumbMaterial>(desc_.material_count);
      triangle_materials_ = in.list<std::uint32_t>(triangles_of(desc_));
    }
    in.finish();
  }

  /// Lives as long as this.
  [[nodiscard]] PlumbShapeDesc desc() const {
    PlumbShapeDesc desc = desc_;
    (desc.type == PLUMB_HEIGHT_FIELD ? desc.heights : desc.vertices) = numbers_.data();
    desc.indices = indices_.data();
    desc.materials = materials_.data();
    desc.triangle_materials = triangle_materials_.data();
    return desc;
  }

 private:
  PlumbShapeDesc desc_;
  std::vector<double> numbers_;  ///< coordinates of vertices, or heights
  std::vector<std::uint32_t> indices_, triangle_materials_;
  std::vector<PlumbMaterial> materials_;
};

}  // namespace plumb::backend
