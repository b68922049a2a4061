// Axis-aligned boxes, the bounds in the trees of the broad phase.
#pragma once

#include "math/vec3.hpp"

namespace plumb::impulse {

/// Corners relative to the world's origin of bounds (a place in double near the scene), rounded outward.
struct Box {
  Vec low, high;
};

/// What no box reaches beyond and any merge replaces.
PLUMB_HD constexpr Box empty_box() { return {{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}}; }
/// Touching counts.
PLUMB_HD constexpr bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}
PLUMB_HD constexpr Box merged(const Box& a, const Box& b) { return {min(a.low, b.low), max(a.high, b.high)}; }

}  // namespace plumb::impulse
