// What of a body lies on its shapes: where they are, materials and filters.
#include "body.hpp"

namespace plumb::box3d {
namespace {

b3Filter filter_of(const PlumbFilter& filter) { return {filter.category, filter.mask, filter.group}; }

/// Box3D resists rolling and spinning alike, of spheres and capsules alone, by a share of their radius.
float rolling_resistance(const PlumbBodyDesc& desc, const Shape& shape) {
  const bool round = shape.is_sphere() || shape.type == PLUMB_CAPSULE;
  return round ? scalar(desc.rolling_friction, "rolling_friction") / shape.radius : 0;
}

b3SurfaceMaterial material_of(const PlumbMaterial& material, float rolling = 0) {
  b3SurfaceMaterial made = b3DefaultSurfaceMaterial();
  made.friction = scalar(material.friction, "friction");
  made.restitution = static_cast<float>(material.restitution);
  made.rollingResistance = rolling;
  made.tangentVelocity = vector(material.surface_velocity, "surface_velocity");
  return made;
}

b3ShapeId make_box3d_shape(b3BodyId body, const b3ShapeDef& def, const Shape& shape, const PlumbPose* pose) {
  const b3Transform at = pose == nullptr ? b3Transform_identity : transform(*pose, "position of a child");
  if (shape.is_sphere()) {
    const b3Sphere sphere{at.p, shape.radius};
    return b3CreateSphereShape(body, &def, &sphere);
  }
  if (shape.type == PLUMB_CAPSULE) {
    const b3Vec3 up = b3RotateVector(at.q, {0, shape.half_height, 0});
    const b3Capsule capsule{b3Sub(at.p, up), b3Add(at.p, up), shape.radius};
    return b3CreateCapsuleShape(body, &def, &capsule);
  }
  if (shape.mesh) return b3CreateMeshShape(body, &def, shape.mesh.get(), {1, 1, 1});
  if (pose == nullptr) return b3CreateHullShape(body, &def, shape.hull.get());
  return b3CreateTransformedHullShape(body, &def, shape.hull.get(), at, {1, 1, 1});
}

}  // namespace

void attach_shapes(Body& body, bool sensed) {
  b3ShapeDef def = b3DefaultShapeDef();
  def.density = 0;
  def.updateBodyMass = false;
  def.filter = filter_of(body.desc.filter);
  def.isSensor = body.is_sensor();
  def.enableSensorEvents = sensed;
  def.enableCustomFiltering = true;  // excluded pairs; asked once when two come near each other
  const auto add = [&](const Shape& shape, const PlumbMaterial& material, std::uintptr_t child, const PlumbPose* pose) {
    def.baseMaterial = material_of(material, rolling_resistance(body.desc, shape));
    std::vector<b3SurfaceMaterial> by_triangle;
    if (!shape.materials.empty()) by_triangle.push_back(def.baseMaterial);
    for (const PlumbMaterial& row : shape.materials) by_triangle.push_back(material_of(row));
    def.materials = by_triangle.data();
    def.materialCount = static_cast<int>(by_triangle.size());
    def.userData = reinterpret_cast<void*>(child);
    const b3ShapeId id = make_box3d_shape(body.id, def, shape, pose);
    if (!b3Shape_IsValid(id)) throw Error(PLUMB_E_OUT_OF_MEMORY, "Box3D made no shape; it holds 4 million");
    body.shapes.push_back(id);
  };
  if (body.shape->type != PLUMB_COMPOUND) return add(*body.shape, body.desc.material, 0, nullptr);
  std::uintptr_t index = 0;
  for (const Shape::Child& child : body.shape->children)
    add(*child.shape, child.has_material ? child.material : body.desc.material, index++, &child.pose);
}

void apply_material(const Body& body) {
  for (std::size_t i = 0; i < body.shapes.size(); ++i) {
    const Shape::Child* child = body.shape->children.empty() ? nullptr : &body.shape->children[i];
    const Shape& shape = child == nullptr ? *body.shape : *child->shape;
    const bool own = child != nullptr && child->has_material;
    const PlumbMaterial& material = own ? child->material : body.desc.material;
    if (!body.shape->materials.empty())
      b3Shape_SetMeshMaterial(body.shapes[i], material_of(material), 0);
    else
      b3Shape_SetSurfaceMaterial(body.shapes[i], material_of(material, rolling_resistance(body.desc, shape)));
  }
}

void apply_filter(const Body& body) {
  for (const b3ShapeId shape : body.shapes) b3Shape_SetFilter(shape, filter_of(body.desc.filter), true);
}

/// Box3D does nothing where a filter stays as it is.
void find_pairs_again(const Body& body) {
  constexpr std::uint64_t beyond_ours = std::uint64_t{1} << 63;
  for (const b3ShapeId shape : body.shapes) {
    b3Filter filter = filter_of(body.desc.filter);
    filter.categoryBits ^= beyond_ours;
    b3Shape_SetFilter(shape, filter, true);
  }
  apply_filter(body);
}

}  // namespace plumb::box3d
