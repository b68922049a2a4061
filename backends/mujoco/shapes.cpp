#include "shapes.hpp"

#include <cmath>

namespace plumb::mujoco {
namespace {

/// MuJoCo's rows go the other way, its y being our -z; so both cut their cells along the same diagonal.
Shape::Field field_of(const PlumbShapeDesc& desc) {
  const std::size_t count = std::size_t{desc.rows} * desc.columns;
  const auto [low, high] = std::minmax_element(desc.heights, desc.heights + count);
  Shape::Field field{desc.rows,
                     desc.columns,
                     (desc.columns - 1) * desc.spacing.x / 2,
                     (desc.rows - 1) * desc.spacing.z / 2,
                     *low,
                     std::max(*high - *low, 1e-3),
                     {}};
  for (std::uint32_t r = desc.rows; r-- > 0;)
    for (std::uint32_t c = 0; c < desc.columns; ++c)
      field.heights.push_back(static_cast<float>((desc.heights[r * desc.columns + c] - field.lowest) / field.span));
  return field;
}

PlumbVec3 normal_of_box(const PlumbVec3& half, const PlumbVec3& p) {
  const PlumbVec3 share{p.x / half.x, p.y / half.y, p.z / half.z};
  const double x = std::abs(share.x), y = std::abs(share.y), z = std::abs(share.z);
  if (x >= y && x >= z) return {std::copysign(1.0, share.x), 0, 0};
  if (y >= z) return {0, std::copysign(1.0, share.y), 0};
  return {0, 0, std::copysign(1.0, share.z)};
}

PlumbVec3 normal_of_cylinder(const Shape& shape, const PlumbVec3& p) {
  const double around = std::hypot(p.x, p.z);
  if (std::abs(p.y) / shape.half_height > around / shape.radius) return {0, std::copysign(1.0, p.y), 0};
  return {p.x / around, 0, p.z / around};
}

PlumbVec3 normal_of_hull(const backend::ConvexHull& hull, const PlumbVec3& p) {
  const backend::HullFace* best = &hull.faces.front();
  for (const backend::HullFace& face : hull.faces)
    if (dot(face.normal, p) - face.offset > dot(best->normal, p) - best->offset) best = &face;
  return best->normal;
}

/// The triangle of a height field above or below a point: height there, and its slopes.
struct Slope {
  double height, along_x, along_z;
};
Slope slope_at(const Shape::Field& field, const PlumbVec3& p) {
  const double step_x = 2 * field.half_x / (field.columns - 1), step_z = 2 * field.half_z / (field.rows - 1);
  const auto cell = [](double at, std::uint32_t count) { return std::clamp(std::floor(at), 0.0, count - 2.0); };
  const double x = (p.x + field.half_x) / step_x, z = (p.z + field.half_z) / step_z;
  const double c = cell(x, field.columns), r = cell(z, field.rows), u = x - c, v = z - r;
  const auto height = [&](double row, double column) {
    const double mirrored = field.rows - 1 - row;
    return field.lowest +
           field.span * static_cast<double>(field.heights[static_cast<std::size_t>(mirrored * field.columns + column)]);
  };
  const double h01 = height(r, c + 1), h10 = height(r + 1, c);
  if (u + v <= 1) {
    const double h = height(r, c);
    return {h + u * (h01 - h) + v * (h10 - h), (h01 - h) / step_x, (h10 - h) / step_z};
  }
  const double h = height(r + 1, c + 1);
  return {h + (1 - u) * (h10 - h) + (1 - v) * (h01 - h), (h - h10) / step_x, (h - h01) / step_z};
}

PlumbVec3 normal_of_field(const Shape::Field& field, const PlumbVec3& p) {
  const Slope slope = slope_at(field, p);
  return normalized(PlumbVec3{-slope.along_x, 1, -slope.along_z});
}

}  // namespace

std::unique_ptr<Shape> make_shape(const PlumbShapeDesc& desc, PlumbShape handle, std::vector<const Shape*> children) {
  auto shape = std::make_unique<Shape>();
  shape->handle = handle;
  shape->type = desc.type;
  shape->radius = desc.radius;
  shape->half_height = desc.half_height;
  shape->half_extents = desc.half_extents;
  if (desc.type == PLUMB_CONVEX_HULL) shape->hull = backend::convex_hull(desc);
  if (desc.type == PLUMB_HEIGHT_FIELD) shape->field = field_of(desc);
  for (std::uint32_t i = 0; desc.type == PLUMB_COMPOUND && i < desc.child_count; ++i) {
    const PlumbCompoundChild& child = desc.children[i];
    shape->children.push_back({children[i], child.pose, child.has_material != 0, child.material});
  }
  return shape;
}

std::string asset_name(const Shape& shape) { return "s" + std::to_string(slot_of(shape.handle)); }

PlumbPose geom_frame(const Shape& shape) {
  switch (shape.type) {
    case PLUMB_CAPSULE:
    case PLUMB_CYLINDER:
    case PLUMB_PLANE: return {{0, 0, 0}, kZToY};
    case PLUMB_HEIGHT_FIELD: return {{0, shape.field.lowest, 0}, kZToY};
    default: return identity_pose();
  }
}

PlumbVec3 normal_at(const Shape& shape, const PlumbVec3& p) {
  switch (shape.type) {
    case PLUMB_SPHERE: return normalized(p);
    case PLUMB_BOX: return normal_of_box(shape.half_extents, p);
    case PLUMB_CAPSULE:
      return normalized(PlumbVec3{p.x, p.y - std::clamp(p.y, -shape.half_height, shape.half_height), p.z});
    case PLUMB_CYLINDER: return normal_of_cylinder(shape, p);
    case PLUMB_CONVEX_HULL: return normal_of_hull(shape.hull, p);
    case PLUMB_HEIGHT_FIELD: return normal_of_field(shape.field, p);
    default: return {0, 1, 0};
  }
}

bool is_on_surface(const Shape& shape, const PlumbVec3& point) {
  return shape.type != PLUMB_HEIGHT_FIELD || std::abs(slope_at(shape.field, point).height - point.y) < 1e-4;
}

}  // namespace plumb::mujoco
