// A shape's geometry as 64 bits: by it a snapshot of a whole world knows the shapes that its bodies had.
#pragma once

#include <span>

#include "plumb/backend/check_descs.hpp"
#include "plumb/backend/state_hash.hpp"
#include "plumb/plumb.h"

namespace plumb::backend {

/// desc: as check_shape() passes it. children: the contents of a compound's children, in order.
[[nodiscard]] inline std::uint64_t shape_content(const PlumbShapeDesc& desc, std::span<const std::uint64_t> children) {
  StateHash hash;
  const auto add_all = [&hash](const double* numbers, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) hash.add(numbers[i]);
  };
  const auto add_vec = [&](const PlumbVec3& v) { add_all(&v.x, 3); };
  hash.add_word(desc.type);
  switch (desc.type) {
    case PLUMB_SPHERE: hash.add(desc.radius); break;
    case PLUMB_BOX: add_vec(desc.half_extents); break;
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER:
      hash.add(desc.radius);
      hash.add(desc.half_height);
      break;
    case PLUMB_CONVEX_HULL:
    case PLUMB_TRIANGLE_MESH:
      add_all(desc.vertices, std::size_t{3} * desc.vertex_count);
      for (std::size_t i = 0; desc.type == PLUMB_TRIANGLE_MESH && i < std::size_t{3} * desc.triangle_count; ++i)
        hash.add_word(desc.indices[i]);
      break;
    case PLUMB_HEIGHT_FIELD:
      hash.add_word(desc.columns);
      hash.add(desc.spacing.x);
      hash.add(desc.spacing.z);
      add_all(desc.heights, std::size_t{desc.rows} * desc.columns);
      break;
    case PLUMB_COMPOUND:
      for (std::size_t i = 0; i < desc.child_count; ++i) {
        const PlumbCompoundChild& child = desc.children[i];
        hash.add_word(children[i]);
        add_vec(child.pose.position);
        add_all(&child.pose.orientation.x, 4);
        hash.add_word(child.has_material);
        if (child.has_material == 0) continue;
        hash.add(child.material.friction);
        hash.add(child.material.restitution);
        add_vec(child.material.surface_velocity);
      }
      break;
    default: break;
  }
  if (has_triangle_materials(desc)) {
    for (std::uint32_t i = 0; i < desc.material_count; ++i) {
      hash.add(desc.materials[i].friction);
      hash.add(desc.materials[i].restitution);
    }
    for (std::size_t t = 0; t < triangles_of(desc); ++t) hash.add_word(desc.triangle_materials[t]);
  }
  return hash.value();
}

}  // namespace plumb::backend
