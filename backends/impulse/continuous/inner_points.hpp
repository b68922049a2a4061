// Points well inside of a convex shape, one in its middle and others towards the ends of what is long, and how deep
// within the surface they are.
#pragma once

#include "geometry/shape.hpp"

namespace plumb::impulse {

struct InnerPoints {
  static constexpr int kMost = 7;
  Vec at[kMost];
  int count = 1;
  Real depth = 0;  ///< of all of them, at least, m

  PLUMB_HD InnerPoints(const Shape& shape, const Hulls& hulls) {
    at[0] = {0, 0, 0};
    switch (shape.type) {
      case ShapeType::kSphere: depth = shape.size.x; return;
      case ShapeType::kCapsule: spread({0, shape.size.x + shape.size.y, 0}, shape.size.x); return;
      case ShapeType::kCylinder:
        spread({shape.size.x, shape.size.y, shape.size.x}, min(shape.size.x, shape.size.y));
        return;
      case ShapeType::kBox: spread(shape.size, min(shape.size.x, min(shape.size.y, shape.size.z))); return;
      case ShapeType::kHull: {
        const HullRange& hull = hulls.ranges[shape.hull];
        at[0] = hull.centre;
        depth = kHuge;
        for (std::uint32_t f = 0; f < hull.face_count; ++f) {
          const HullFace& face = hulls.faces[hull.first_face + f];
          depth = min(depth, face.offset - dot(face.normal, hull.centre));
        }
        return;
      }
      default: count = 0;
    }
  }

 private:
  PLUMB_HD void spread(const Vec& half, Real thickness) {
    depth = thickness;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(half[axis] > 2 * thickness)) continue;
      Vec end = {0, 0, 0};
      end[axis] = half[axis] - thickness;
      at[count++] = end;
      at[count++] = -end;
    }
  }
};

}  // namespace plumb::impulse
