// Two shapes as they lie: what pair functions (collide.hpp) are asked about.
#pragma once

#include "geometry/shape.hpp"

namespace plumb::impulse {

struct ShapePair {
  const Shape &a, &b;
  Quat qa, qb;
  Vec d;        ///< from A's origin to B's, axes of the world
  Real margin;  ///< points whose separation is at most this are wanted; at least 0

  [[nodiscard]] PLUMB_HD ShapePair swapped() const { return {b, a, qb, qa, -d, margin}; }
};

}  // namespace plumb::impulse
