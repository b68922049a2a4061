#include "convert/write/gltf/gltf_colliders.hpp"

#include <fmt/format.h>

#include "convert/write/gltf/gltf_filters.hpp"
#include "convert/write/surface.hpp"

namespace plumb::harness {
namespace {

Json round_shape(const char* type, const PlumbShapeDesc& desc) {
  return {{"type", type},
          {type, {{"height", 2 * desc.half_height}, {"radiusBottom", desc.radius}, {"radiusTop", desc.radius}}}};
}

/// In KHR_implicit_shapes capsules and cylinders lie along y and planes look along it, as in scenes; what has no height
/// is no capsule.
Json implicit_shape(const PlumbShapeDesc& desc) {
  const PlumbVec3& half = desc.half_extents;
  switch (desc.type) {
    case PLUMB_BOX: return {{"type", "box"}, {"box", {{"size", {2 * half.x, 2 * half.y, 2 * half.z}}}}};
    case PLUMB_CYLINDER: return round_shape("cylinder", desc);
    case PLUMB_CAPSULE:
      if (desc.half_height > 0) return round_shape("capsule", desc);
      [[fallthrough]];
    case PLUMB_SPHERE: return {{"type", "sphere"}, {"sphere", {{"radius", desc.radius}}}};
    default: return {{"type", "plane"}, {"plane", Json::object()}};
  }
}

/// Of two restitutions scenes take the larger one. What they make of two frictions, glTF cannot say: its own way is the
/// average, which for two that are equal is the same.
Json material_json(const PlumbMaterial& material) {
  return {{"staticFriction", material.friction},
          {"dynamicFriction", material.friction},
          {"restitution", material.restitution},
          {"restitutionCombine", "maximum"}};
}

}  // namespace

GltfColliders::GltfColliders(const Scene& scene, GltfDraft& draft)
    : scene_(scene), draft_(draft), filters_(add_filters(scene, draft)) {}

/// A node that has a mesh is its own geometry, and can be seen.
Json GltfColliders::geometry_of(std::size_t shape, std::size_t node) {
  const PlumbShapeDesc& desc = scene_.shapes[shape].desc;
  if (!has_surface(desc.type)) return {{"shape", draft_.add_shape(implicit_shape(desc))}};
  const auto [mesh, is_new] = meshes_.try_emplace(shape);
  if (is_new) mesh->second = draft_.add_mesh(surface_of(scene_, shape));
  draft_.node(node)["mesh"] = mesh->second;
  return {{"node", node}, {"convexHull", desc.type == PLUMB_CONVEX_HULL}};
}

void GltfColliders::write_part(std::size_t body, std::size_t node, std::size_t shape, const PlumbMaterial& material) {
  const bool senses = (scene_.bodies[body].desc.flags & PLUMB_BODY_SENSOR) != 0;
  Json part{{"geometry", geometry_of(shape, node)}};
  if (!senses) part["physicsMaterial"] = draft_.add("physicsMaterials", material_json(material));
  if (filters_[body]) part["collisionFilter"] = *filters_[body];
  draft_.physics(node)[senses ? "trigger" : "collider"] = std::move(part);
}

void GltfColliders::write(std::size_t index, std::size_t node) {
  const SceneBody& body = scene_.bodies[index];
  if (!body.shape) return;
  const SceneShape& shape = scene_.shapes[*body.shape];
  if (shape.desc.type != PLUMB_COMPOUND) return write_part(index, node, *body.shape, body.desc.material);
  Json parts = Json::array();
  for (const SceneShape::Child& child : shape.children) {
    parts.push_back(draft_.add_node(fmt::format("{}/{}", body.name, parts.size()), child.pose, node));
    write_part(index, parts.back(), child.shape, child.material.value_or(body.desc.material));
  }
  if ((body.desc.flags & PLUMB_BODY_SENSOR) != 0) draft_.physics(node)["trigger"]["nodes"] = parts;
}

}  // namespace plumb::harness
