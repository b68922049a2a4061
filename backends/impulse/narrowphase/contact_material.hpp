// The material of a contact: a triangle of a mesh or height field may have its own.
#pragma once

#include "bodies/body.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

PLUMB_HD inline const TriangleMaterials& materials_of(const Shape& surface, const Surfaces& surfaces) {
  return surface.type == ShapeType::kMesh ? surfaces.meshes[surface.hull].materials
                                          : surfaces.fields[surface.hull].materials;
}

/// Of a proxy where a triangle is touched, which counts if it is a surface.
PLUMB_HD inline Material material_at(const Proxies& proxies, const Proxy& proxy, std::uint32_t triangle) {
  const Shape& shape = proxies.shapes[proxy.shape];
  if (!is_surface(shape.type)) return proxy.material;
  const TriangleMaterials& materials = materials_of(shape, proxies.surfaces);
  const std::uint32_t row = materials.row(triangle);
  return row == PLUMB_BODY_MATERIAL ? proxy.material : materials.rows[row];
}

/// Of both where a candidate touches.
PLUMB_HD inline Material contact_material(const ContactCache& cache, const Proxies& proxies, std::uint32_t candidate) {
  const Pair pair = cache.pairs[candidate];
  const Proxy &a = proxies.rows[pair.a], &b = proxies.rows[pair.b];
  if (proxies.surfaces.with_materials == 0 || cache.triangles == nullptr) return combined(a.material, b.material);
  const std::uint32_t triangle = cache.triangles[candidate];
  return combined(material_at(proxies, a, triangle), material_at(proxies, b, triangle));
}

}  // namespace plumb::impulse
