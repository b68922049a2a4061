// What tests of closed forms count in.
#pragma once

#include <numbers>

namespace plumb::truth {

inline constexpr double g = 9.81;                         ///< m/s^2
inline constexpr double degree = std::numbers::pi / 180;  ///< rad
inline constexpr double digits = 6e-9;                    ///< half of the last of eight decimals, and a little

}  // namespace plumb::truth
