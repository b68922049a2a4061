// Two shapes as they lie: what pair functions (collide.hpp) are asked about.
#pragma once

#include "geometry/shape.hpp"

namespace plumb::impulse {

struct ShapePair {
  const Shape &a, &b;
  Quat qa, qb;
  Vec d;                     ///< from A's origin to B's, axes of the world
  Real margin;               ///< points whose separation is at most this are wanted; at least 0
  bool from_behind = false;  ///< of a sheet: it is to push to its inside (triangle/sided_surface.hpp)

  [[nodiscard]] PLUMB_HD ShapePair swapped() const { return {b, a, qb, qa, -d, margin, from_behind}; }
};

}  // namespace plumb::impulse
