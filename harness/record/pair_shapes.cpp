#include "record/pair_shapes.hpp"

#include <cmath>
#include <utility>

namespace plumb::harness {

namespace {

SceneShape shape_of(PlumbShapeType type) {
  SceneShape shape;
  shape.desc = shape_desc(type);
  return shape;
}

// The descriptor counts what the shape's arrays hold.
SceneShape counted(SceneShape shape) {
  shape.desc.vertex_count = static_cast<std::uint32_t>(shape.vertices.size() / 3);
  shape.desc.triangle_count = static_cast<std::uint32_t>(shape.indices.size() / 3);
  return shape;
}

SceneShape box(double x, double y, double z) {
  SceneShape shape = shape_of(PLUMB_BOX);
  shape.desc.half_extents = {x, y, z};
  return shape;
}

SceneShape round(PlumbShapeType type, double radius, double half_height) {
  SceneShape shape = shape_of(type);
  shape.desc.radius = radius;
  shape.desc.half_height = half_height;
  return shape;
}

// A cut stone: a hexagon below, a smaller triangle above, so that faces of three, four and six corners are there.
SceneShape hull() {
  SceneShape shape = shape_of(PLUMB_CONVEX_HULL);
  for (int i = 0; i < 6; ++i) {
    const double angle = i * M_PI / 3;
    for (const double x : {0.5 * std::cos(angle), -0.35, 0.5 * std::sin(angle)}) shape.vertices.push_back(x);
  }
  for (int i = 0; i < 3; ++i) {
    const double angle = (2 * i + 0.5) * M_PI / 3;
    for (const double x : {0.3 * std::cos(angle), 0.4, 0.3 * std::sin(angle)}) shape.vertices.push_back(x);
  }
  return counted(std::move(shape));
}

// A roof over a square: two slopes that meet in a ridge along z.
SceneShape mesh() {
  SceneShape shape = shape_of(PLUMB_TRIANGLE_MESH);
  shape.vertices = {-1.2, 0, -1.2, 0, 0.4, -1.2, 1.2, 0, -1.2, -1.2, 0, 1.2, 0, 0.4, 1.2, 1.2, 0, 1.2};
  shape.indices = {0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5};
  return counted(std::move(shape));
}

SceneShape height_field() {
  constexpr std::uint32_t side = 9;
  SceneShape shape = shape_of(PLUMB_HEIGHT_FIELD);
  shape.desc.rows = shape.desc.columns = side;
  shape.desc.spacing = {0.3, 0, 0.3};
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column)
      shape.heights.push_back(0.2 * std::cos(0.9 * row) * std::cos(0.9 * column));
  return shape;
}

std::vector<SceneShape> compound() {
  SceneShape angle = shape_of(PLUMB_COMPOUND);
  angle.children.push_back({0, {{0, -0.3, 0}, {0, 0, 0, 1}}, {}});
  angle.children.push_back({1, {{-0.35, 0.15, 0}, {0, 0, 0, 1}}, {}});
  return {box(0.5, 0.15, 0.25), box(0.15, 0.3, 0.25), angle};
}

}  // namespace

std::vector<KindOfShape> kinds_of_shapes() {
  return {{"sphere", {round(PLUMB_SPHERE, 0.45, 0)}, true, 0.45},
          {"box", {box(0.5, 0.35, 0.4)}, true, 0.5},
          {"capsule", {round(PLUMB_CAPSULE, 0.25, 0.35)}, true, 0.45},
          {"cylinder", {round(PLUMB_CYLINDER, 0.4, 0.35)}, true, 0.45},
          {"hull", {hull()}, true, 0.45},
          {"compound", compound(), true, 0.45},
          {"mesh", {mesh()}, false, 0.4},
          {"height_field", {height_field()}, false, 0.2},
          {"plane", {shape_of(PLUMB_PLANE)}, false, 0}};
}

}  // namespace plumb::harness
