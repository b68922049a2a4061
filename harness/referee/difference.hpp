// What GJK and the expanding polytope search: points of the Minkowski difference of two shapes.
#pragma once

#include "referee/shape.hpp"

namespace plumb::referee {

/// A point of the difference a - b, and the two that it came from.
struct Difference {
  Vec3 point = Vec3::Zero(), on_a = Vec3::Zero(), on_b = Vec3::Zero();
};

}  // namespace plumb::referee
