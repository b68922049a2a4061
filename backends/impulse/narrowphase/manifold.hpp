// What two touching bodies share: up to four points on one contact plane.
#pragma once

#include <cstdint>

#include "math/vec3.hpp"

namespace plumb::impulse {

constexpr int kManifoldPoints = 4;

struct ManifoldPoint {
  Vec position;           ///< midway between the two surfaces; from the origin of the first shape, world axes, m
  Real separation;        ///< along the normal; negative: overlap, m
  std::uint32_t feature;  ///< which features of both shapes meet here: the same from step to step while they do
};

struct Manifold {
  std::uint32_t count;
  Real gap = 0;  ///< shapes that do not touch are at least so far apart, m, where collision saw it; else 0
  Vec normal;    ///< unit, from the first shape to the second, world axes
  ManifoldPoint points[kManifoldPoints];
};

}  // namespace plumb::impulse
