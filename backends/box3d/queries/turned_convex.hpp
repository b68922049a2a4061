// A convex shape turned into world axes about its origin, as Box3D's queries take it.
#pragma once

#include <vector>

#include "shapes.hpp"

namespace plumb::box3d {

struct TurnedConvex {
  TurnedConvex(const Shape& shape, const PlumbQuat& orientation) {
    const Convex convex = convex_of(shape);
    const b3ShapeProxy local = convex.proxy();
    const b3Quat turn = quaternion(orientation);
    for (int i = 0; i < local.count; ++i) points.push_back(b3RotateVector(turn, local.points[i]));
    proxy = {points.data(), local.count, local.radius};
  }
  TurnedConvex(const TurnedConvex&) = delete;
  TurnedConvex& operator=(const TurnedConvex&) = delete;

  std::vector<b3Vec3> points;
  b3ShapeProxy proxy{};
};

}  // namespace plumb::box3d
