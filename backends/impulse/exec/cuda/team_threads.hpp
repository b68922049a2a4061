#pragma once

#include <cstdint>

namespace plumb::impulse {

/// Threads of a block of a team: few, so that a loop still spreads over the device.
inline constexpr std::uint32_t kTeamThreads = 128;

}  // namespace plumb::impulse
