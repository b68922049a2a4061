#pragma once

#include <cstdint>

namespace plumb::impulse {

/// Threads of a block of a team: few, so that a loop still spreads over the device.
inline constexpr std::uint32_t kTeamThreads = 128;
/// Of a block that does a whole world, where there are so many worlds that more would stand in each other's way.
inline constexpr std::uint32_t kThreadsOfOneOfMany = 64;

}  // namespace plumb::impulse
