// Where a line enters a convex shape and where it leaves it, in the shape's frame and in double: a ray may begin 100 km
// away and be as long, and still meets a pebble where it is.
#pragma once

#include "narrowphase/convex/core.hpp"

// Rays spend their time here; a call costs a tenth of it.
#if defined(__CUDACC__)
#define PLUMB_IN_PLACE __forceinline__
#else
#define PLUMB_IN_PLACE [[gnu::always_inline]] inline
#endif

namespace plumb::impulse {

using Vec64 = Vec3<double>;
using Quat64 = Quat4<double>;

/// The part of the line p + s d that is within a shape, and the surface's normal where it enters.
struct LinePart {
  double enter, leave;
  Vec64 normal;
};

namespace line_shapes {

constexpr double kFar = 1e300;

/// d is a unit vector. Touching counts.
PLUMB_HD PLUMB_IN_PLACE bool cross_ball(const Vec64& centre, double radius, const Vec64& p, const Vec64& d,
                                        LinePart& part) {
  const Vec64 from = p - centre;
  const double along = -dot(from, d);
  const Vec64 beside = from + along * d;
  const double far = length(beside), inside = (radius - far) * (radius + far);
  if (!(inside >= 0)) return false;
  const double half = sqrt(inside);
  part.enter = along - half;
  part.leave = along + half;
  part.normal = (1 / radius) * (beside - half * d);
  return true;
}

/// The slabs of Kay and Kajiya, "Ray tracing complex scenes", 1986.
PLUMB_HD PLUMB_IN_PLACE bool cross_box(const Vec64& half, const Vec64& p, const Vec64& d, LinePart& part) {
  part = {-kFar, kFar, {0, 0, 0}};
  int axis = 0;
  for (int k = 0; k < 3; ++k) {
    if (d[k] == 0) {
      if (abs(p[k]) > half[k]) return false;
      continue;
    }
    const double side = d[k] > 0 ? half[k] : -half[k];
    const double enter = (-side - p[k]) / d[k], leave = (side - p[k]) / d[k];
    if (enter > part.enter) {
      part.enter = enter;
      axis = k;
    }
    part.leave = min(part.leave, leave);
  }
  part.normal[axis] = d[axis] > 0 ? -1 : 1;
  return part.enter <= part.leave;
}

/// Where the line passes the surface of the capsule's tube, if that is between its ends, else of the ball at that end.
PLUMB_HD PLUMB_IN_PLACE bool cross_capsule(double radius, double half, const Vec64& p, const Vec64& d, LinePart& part) {
  const double across = d.x * d.x + d.z * d.z;
  if (!(across > 0)) {  // along the axis
    LinePart last;
    const double up = d.y > 0 ? half : -half;
    if (!cross_ball({0, -up, 0}, radius, p, d, part) || !cross_ball({0, up, 0}, radius, p, d, last)) return false;
    part.leave = last.leave;
    return true;
  }
  const double middle = -(p.x * d.x + p.z * d.z) / across;
  const double x = p.x + middle * d.x, z = p.z + middle * d.z, far = sqrt(x * x + z * z);
  const double inside = (radius - far) * (radius + far);
  if (!(inside >= 0)) return false;
  const double chord = sqrt(inside / across), enter = middle - chord, leave = middle + chord;
  const double low = p.y + enter * d.y, high = p.y + leave * d.y;
  const double end_low = clamp(low, -half, half), end_high = clamp(high, -half, half);
  if (low == end_low)
    part = {enter, leave, {(p.x + enter * d.x) / radius, 0, (p.z + enter * d.z) / radius}};
  else if (!cross_ball({0, end_low, 0}, radius, p, d, part))
    return false;
  part.leave = leave;
  if (high == end_high) return true;
  LinePart last;
  if (!cross_ball({0, end_high, 0}, radius, p, d, last)) return false;
  part.leave = last.leave;
  return true;
}

/// Where the line enters the tube last or the slab between the caps, and leaves either first.
PLUMB_HD inline bool cross_cylinder(double radius, double half, const Vec64& p, const Vec64& d, LinePart& part) {
  part = {-kFar, kFar, {0, 0, 0}};
  const double across = d.x * d.x + d.z * d.z;
  const double middle = across > 0 ? -(p.x * d.x + p.z * d.z) / across : 0;
  const double x = p.x + middle * d.x, z = p.z + middle * d.z, far = sqrt(x * x + z * z);
  const double inside = (radius - far) * (radius + far);
  if (!(inside >= 0)) return false;
  if (across > 0) {
    const double chord = sqrt(inside / across);
    part.enter = middle - chord;
    part.leave = middle + chord;
    part.normal = {(x - chord * d.x) / radius, 0, (z - chord * d.z) / radius};
  }
  if (d.y == 0) return abs(p.y) <= half;
  const double side = d.y > 0 ? half : -half, enter = (-side - p.y) / d.y, leave = (side - p.y) / d.y;
  if (enter > part.enter) {
    part.enter = enter;
    part.normal = {0, d.y > 0 ? -1.0 : 1.0, 0};
  }
  part.leave = min(part.leave, leave);
  return part.enter <= part.leave;
}

/// Face by face (Cyrus and Beck, "Generalized two- and three-dimensional clipping", 1978).
PLUMB_HD PLUMB_IN_PLACE bool cross_hull(const Hulls& hulls, std::uint32_t row, const Vec64& p, const Vec64& d,
                                        LinePart& part) {
  const HullRange& hull = hulls.ranges[row];
  part = {-kFar, kFar, {0, 0, 0}};
  std::uint32_t entered = 0;
  for (std::uint32_t f = 0; f < hull.face_count; ++f) {
    const HullFace& face = hulls.faces[hull.first_face + f];
    const Vec64 n = to_numbers<double>(face.normal);
    const double below = static_cast<double>(face.offset) - dot(n, p), speed = dot(n, d);
    if (speed == 0) {
      if (below < 0) return false;
      continue;
    }
    const double at = below / speed;
    if (speed > 0) {
      part.leave = min(part.leave, at);
    } else if (at > part.enter) {
      part.enter = at;
      entered = f;
    }
    if (part.enter > part.leave) return false;
  }
  part.normal = to_numbers<double>(hulls.faces[hull.first_face + entered].normal);
  return true;
}

}  // namespace line_shapes

/// False where the line passes the shape by. d is a unit vector; a line that only touches crosses. Kernels of scenes
/// without cylinders are the smaller for not knowing them; each has its own copy of all this.
template <bool kCylinders>
PLUMB_HD PLUMB_IN_PLACE bool cross_convex(const Shape& shape, const Hulls& hulls, const Vec64& p, const Vec64& d,
                                          LinePart& part) {
  const Vec64 size = to_numbers<double>(shape.size);
  switch (shape.type) {
    case ShapeType::kSphere: return line_shapes::cross_ball({0, 0, 0}, size.x, p, d, part);
    case ShapeType::kBox: return line_shapes::cross_box(size, p, d, part);
    case ShapeType::kCapsule: return line_shapes::cross_capsule(size.x, size.y, p, d, part);
    case ShapeType::kHull: return line_shapes::cross_hull(hulls, shape.hull, p, d, part);
    case ShapeType::kCylinder: return kCylinders && line_shapes::cross_cylinder(size.x, size.y, p, d, part);
    default: return false;
  }
}

}  // namespace plumb::impulse
