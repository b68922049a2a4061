// What a joint asks of its axes, for engines whose bodies are trees of joints in generalised coordinates. Shared by
// their adapters; nothing of one engine comes in here.
#pragma once

#include <cstddef>
#include <cstdint>

#include "plumb/backend/usual_capability.hpp"
#include "plumb/plumb.h"

namespace plumb::articulated {

inline constexpr std::uint32_t kTurns = 0b111000;  ///< bits of the axes that turn

/// Bits: the axes that the joint leaves free or limits. A rod has none.
inline std::uint32_t open_axes(const PlumbJointDesc& desc) {
  if (desc.type != PLUMB_JOINT_GENERIC) return desc.type == PLUMB_JOINT_DISTANCE ? 0 : backend::free_axes(desc.type);
  std::uint32_t open = 0;
  for (std::uint32_t axis = 0; axis < 6; ++axis)
    if (desc.axis_modes[axis] != PLUMB_AXIS_LOCKED) open |= 1u << axis;
  return open;
}

inline bool is_limited(const PlumbJointDesc& desc, std::size_t axis) {
  if (desc.type == PLUMB_JOINT_GENERIC) return desc.axis_modes[axis] == PLUMB_AXIS_LIMITED;
  return desc.limits[axis].enabled != 0;
}

/// Whether none of these axes that are open has a limit, a motor or a spring.
inline bool asks_nothing(const PlumbJointDesc& desc, std::uint32_t axes) {
  for (std::size_t axis = 0; axis < 6; ++axis)
    if ((open_axes(desc) & axes & 1u << axis) != 0 &&
        (is_limited(desc, axis) || desc.motors[axis].enabled != 0 || desc.springs[axis].enabled != 0))
      return false;
  return true;
}

/// Whether all three turns are the engine's ball, which knows no single axes: nothing is asked of any of them.
inline bool is_plain_ball(const PlumbJointDesc& desc) {
  return (open_axes(desc) & kTurns) == kTurns && asks_nothing(desc, kTurns);
}

}  // namespace plumb::articulated
