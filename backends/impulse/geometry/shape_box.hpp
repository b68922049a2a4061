// The axis-aligned box of a shape at an orientation, relative to the shape's origin.
#pragma once

#include "geometry/shape.hpp"
#include "math/box.hpp"
#include "math/mat33.hpp"

namespace plumb::impulse {

PLUMB_HD inline Box shape_box(const Shape& shape, const Quat& orientation, const Hulls& hulls) {
  const Vec r = {shape.size.x, shape.size.x, shape.size.x};
  if (shape.type == ShapeType::kSphere) return {-r, r};
  const Mat axes = to_matrix(orientation);
  if (shape.type == ShapeType::kBox || is_surface(shape.type)) {
    const Vec half = shape.size.x * abs(axes.x) + shape.size.y * abs(axes.y) + shape.size.z * abs(axes.z);
    return {-half, half};
  }
  if (shape.type == ShapeType::kCapsule) {
    const Vec half = shape.size.y * abs(axes.y) + r;
    return {-half, half};
  }
  if (shape.type == ShapeType::kCylinder) {
    // Of the disc with normal y: r sqrt(1 - y_k^2), from the other two axes, which lose nothing where y_k is near 1.
    const auto disc = [&](int k) { return sqrt(axes.x[k] * axes.x[k] + axes.z[k] * axes.z[k]); };
    const Vec half = shape.size.y * abs(axes.y) + shape.size.x * Vec{disc(0), disc(1), disc(2)};
    return {-half, half};
  }
  if (shape.type == ShapeType::kPlane) return empty_box();  // in no tree
  const HullRange& hull = hulls.ranges[shape.hull];
  Box box = empty_box();
  for (std::uint32_t i = 0; i < hull.vertex_count; ++i) {
    const Vec vertex = axes * hulls.vertices[hull.first_vertex + i];
    box = {min(box.low, vertex), max(box.high, vertex)};
  }
  return box;
}

}  // namespace plumb::impulse
