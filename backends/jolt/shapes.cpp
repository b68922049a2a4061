#include "shapes.hpp"

#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/ConvexHullShape.h>
#include <Jolt/Physics/Collision/Shape/CylinderShape.h>
#include <Jolt/Physics/Collision/Shape/MeshShape.h>
#include <Jolt/Physics/Collision/Shape/PlaneShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Collision/Shape/StaticCompoundShape.h>

#include <algorithm>

#include "plumb/backend/names.hpp"

namespace plumb::jolt {
namespace {

using Result = JPH::Shape::ShapeResult;

/// m: a plane ends this far from its origin.
constexpr float kPlaneHalfExtent = 5000;
/// m: points are left out of a hull that lie within it of a face. Jolt's own millimetre is taken where it makes no hull
/// with this.
constexpr float kHullTolerance = 1e-5f;

Result make_box(const PlumbShapeDesc& desc, float round) {
  const JPH::Vec3 half = vector(desc.half_extents, "half_extents");
  return JPH::BoxShapeSettings(half, std::min(round, half.ReduceMin())).Create();
}

Result make_capsule(const PlumbShapeDesc& desc) {
  const float half = scalar(desc.half_height, "half_height"), radius = scalar(desc.radius, "radius");
  if (half == 0) return JPH::SphereShapeSettings(radius).Create();
  return JPH::CapsuleShapeSettings(half, radius).Create();
}

Result make_cylinder(const PlumbShapeDesc& desc, float round) {
  const float half = scalar(desc.half_height, "half_height"), radius = scalar(desc.radius, "radius");
  return JPH::CylinderShapeSettings(half, radius, std::min({round, half, radius})).Create();
}

Result make_hull(const PlumbShapeDesc& desc, float round) {
  JPH::Array<JPH::Vec3> points;
  for (std::uint32_t i = 0; i < desc.vertex_count; ++i) points.push_back(vector(desc.vertices + 3 * i, "a vertex"));
  JPH::ConvexHullShapeSettings hull(points, round);
  const float jolts = hull.mHullTolerance;
  hull.mHullTolerance = kHullTolerance;
  const Result exact = hull.Create();
  if (exact.IsValid()) return exact;
  hull.ClearCachedResult();
  hull.mHullTolerance = jolts;
  return hull.Create();
}

Result make_compound(const PlumbShapeDesc& desc, std::span<const Shape* const> children, Shape& shape) {
  JPH::StaticCompoundShapeSettings compound;
  bool any = false;
  for (std::uint32_t i = 0; i < desc.child_count; ++i) {
    const PlumbCompoundChild& child = desc.children[i];
    compound.AddShape(vector(child.pose.position, "position of a child"), quaternion(child.pose.orientation),
                      children[i]->jolt);
    any = any || child.has_material != 0;
  }
  for (std::uint32_t i = 0; any && i < desc.child_count; ++i) {
    shape.children.push_back(desc.children[i].material);
    shape.has_own.push_back(desc.children[i].has_material != 0);
  }
  return compound.Create();
}

Result make(const PlumbShapeDesc& desc, std::span<const Shape* const> children, float round, Shape& shape) {
  switch (desc.type) {
    case PLUMB_SPHERE: return JPH::SphereShapeSettings(scalar(desc.radius, "radius")).Create();
    case PLUMB_BOX: return make_box(desc, round);
    case PLUMB_CAPSULE: return make_capsule(desc);
    case PLUMB_CYLINDER: return make_cylinder(desc, round);
    case PLUMB_CONVEX_HULL: return make_hull(desc, round);
    case PLUMB_PLANE:
      return JPH::PlaneShapeSettings(JPH::Plane(JPH::Vec3::sAxisY(), 0), nullptr, kPlaneHalfExtent).Create();
    case PLUMB_TRIANGLE_MESH: return make_mesh(desc);
    case PLUMB_HEIGHT_FIELD: return make_height_field(desc);
    default: return make_compound(desc, children, shape);
  }
}

/// Of one child Jolt makes the child itself, turned and moved.
std::uint32_t child_of_compound(const JPH::Shape& shape, JPH::SubShapeID part) {
  if (shape.GetSubType() != JPH::EShapeSubType::StaticCompound) return 0;
  JPH::SubShapeID rest;
  return static_cast<const JPH::CompoundShape&>(shape).GetSubShapeIndexFromID(part, rest);
}

std::uint32_t triangle_of(const JPH::Shape& shape, JPH::SubShapeID part) {
  return static_cast<const JPH::MeshShape&>(shape).GetTriangleUserData(part);
}

}  // namespace

std::uint32_t Shape::child_of(JPH::SubShapeID part) const {
  if (type == PLUMB_COMPOUND) return child_of_compound(*jolt, part);
  return type == PLUMB_TRIANGLE_MESH ? triangle_of(*jolt, part) : 0;
}

const PlumbMaterial* Shape::material_of(JPH::SubShapeID part) const {
  if (!triangles.empty()) return triangles.of(triangle_of(*jolt, part));
  if (children.empty()) return nullptr;
  const std::uint32_t child = child_of_compound(*jolt, part);
  return has_own[child] ? &children[child] : nullptr;
}

std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::span<const Shape* const> children,
                                  double convex_radius) {
  auto shape = std::make_unique<Shape>();
  shape->type = desc.type;
  shape->triangles = backend::TriangleMaterials(desc);
  const Result made = make(desc, children, static_cast<float>(convex_radius), *shape);
  if (made.HasError())
    throw Error(PLUMB_E_UNSUPPORTED,
                std::string("Jolt makes no such ") + backend::shape_name(desc.type) + ": " + made.GetError().c_str());
  shape->jolt = made.Get();
  return shape;
}

JPH::Mat44 centre_transform(const JPH::Shape& shape, const PlumbPose& pose, const PlumbVec3& offset) {
  return transform({backend::sub(pose.position, offset), pose.orientation}, "position of a shape")
      .PreTranslated(shape.GetCenterOfMass());
}

}  // namespace plumb::jolt
