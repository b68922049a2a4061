// Of the many points in which ODE lets boxes and triangles touch, those that hold a body as all of them would.
#pragma once

#include <dart/collision/Contact.hpp>
#include <vector>

namespace plumb::dart6 {

/// Of one pair of shapes: of the points whose normals are nearly the same the deepest, and those that are farthest from
/// each other; four at most, as Dantzig's method takes eight times as long for twice the rows.
[[nodiscard]] std::vector<::dart::collision::Contact*> few_points(std::vector<::dart::collision::Contact*> points);

}  // namespace plumb::dart6
