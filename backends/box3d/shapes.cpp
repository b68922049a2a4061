#include "shapes.hpp"

#include <numbers>

namespace plumb::box3d {
namespace {

/// m: a plane's box is as wide and as deep; float still tells a tenth of a millimetre at its rim.
constexpr float kPlaneHalfWidth = 500, kPlaneHalfDepth = 50;

Hull clone(const b3BoxHull& box) { return Hull(b3CloneHull(&box.base)); }

Hull hull_of_points(const PlumbShapeDesc& desc) {
  std::vector<b3Vec3> points;
  for (std::uint32_t i = 0; i < desc.vertex_count; ++i) points.push_back(vector(desc.vertices + 3 * i, "a vertex"));
  return Hull(b3CreateHull(points.data(), static_cast<int>(points.size()), B3_MAX_HULL_VERTICES));
}

/// A prism with the cylinder's volume.
Hull prism(const PlumbShapeDesc& desc, int sides) {
  const double turn = 2 * std::numbers::pi / sides;
  const float radius = scalar(desc.radius * std::sqrt(turn / std::sin(turn)), "radius");
  const float half = scalar(desc.half_height, "half_height");
  return Hull(b3CreateCylinder(2 * half, radius, -half, sides));
}

}  // namespace

bool Shape::is_sphere() const {
  return type == PLUMB_SPHERE || (type == PLUMB_CAPSULE && 2 * half_height <= B3_MIN_CAPSULE_LENGTH);
}

std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, std::vector<const Shape*> children, int cylinder_sides) {
  auto shape = std::make_unique<Shape>();
  shape->type = desc.type;
  switch (desc.type) {
    case PLUMB_CAPSULE: shape->half_height = scalar(desc.half_height, "half_height"); [[fallthrough]];
    case PLUMB_SPHERE: shape->radius = scalar(desc.radius, "radius"); break;
    case PLUMB_BOX: {
      const b3Vec3 half = vector(desc.half_extents, "half_extents");
      shape->hull = clone(b3MakeBoxHull(half.x, half.y, half.z));
      break;
    }
    case PLUMB_CYLINDER: shape->hull = prism(desc, cylinder_sides); break;
    case PLUMB_CONVEX_HULL:
      shape->hull = hull_of_points(desc);
      if (!shape->hull)
        throw Error(PLUMB_E_UNSUPPORTED, "Box3D makes no hull of these " + std::to_string(desc.vertex_count) +
                                             " vertices; it holds at most 128 vertices, 128 faces and 128 edges");
      break;
    case PLUMB_PLANE:
      shape->hull =
          clone(b3MakeOffsetBoxHull(kPlaneHalfWidth, kPlaneHalfDepth, kPlaneHalfWidth, b3Vec3{0, -kPlaneHalfDepth, 0}));
      break;
    case PLUMB_TRIANGLE_MESH: make_mesh(*shape, desc); break;
    case PLUMB_HEIGHT_FIELD: make_height_field(*shape, desc); break;
    default:
      for (std::uint32_t i = 0; i < desc.child_count; ++i) {
        const PlumbCompoundChild& child = desc.children[i];
        shape->children.push_back({children[i], child.pose, child.has_material != 0, child.material});
      }
  }
  return shape;
}

Convex convex_of(const Shape& shape) {
  Convex convex;
  if (shape.is_sphere()) {
    convex.sphere = {b3Vec3_zero, shape.radius};
  } else if (shape.type == PLUMB_CAPSULE) {
    convex.kind = Convex::Kind::capsule;
    convex.capsule = {{0, -shape.half_height, 0}, {0, shape.half_height, 0}, shape.radius};
  } else {
    convex.kind = Convex::Kind::hull;
    convex.hull = shape.hull.get();
  }
  return convex;
}

b3ShapeProxy Convex::proxy() const {
  switch (kind) {
    case Kind::sphere: return {&sphere.center, 1, sphere.radius};
    case Kind::capsule: return {&capsule.center1, 2, capsule.radius};
    default: return {b3GetHullPoints(hull), hull->vertexCount, 0};
  }
}

}  // namespace plumb::box3d
