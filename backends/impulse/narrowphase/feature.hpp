// Feature ids: which part of shape A meets which part of shape B. They name parts, not roles: an id does not change
// when the axis of the contact passes from a face of A to a face of B.
#pragma once

#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

enum class Part : std::uint32_t { kFace = 0, kEdge = 1, kVertex = 2 };

/// Indices beyond 14 bits wrap around: an id is what points are matched by, not where anything lies.
PLUMB_HD constexpr std::uint32_t feature_half(Part part, std::uint32_t index) {
  return (static_cast<std::uint32_t>(part) << 14) | (index & 0x3fffU);
}
PLUMB_HD constexpr std::uint32_t feature_id(Part part_a, std::uint32_t a, Part part_b, std::uint32_t b) {
  return (feature_half(part_a, a) << 16) | feature_half(part_b, b);
}
/// The id of the same contact with A and B swapped.
PLUMB_HD constexpr std::uint32_t swapped_feature(std::uint32_t id) { return (id << 16) | (id >> 16); }

/// Parts of a box. `mask` has bit k set where the part lies on the positive side of axis k.
PLUMB_HD constexpr std::uint32_t box_face(int axis, bool positive) {
  return 2U * static_cast<std::uint32_t>(axis) + (positive ? 1U : 0U);
}
PLUMB_HD constexpr std::uint32_t box_edge(int along, std::uint32_t mask) {
  return (static_cast<std::uint32_t>(along) << 3) | (mask & ~(1U << along));
}

}  // namespace plumb::impulse
