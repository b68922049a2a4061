// How URDF and SDF say a rotation.
#pragma once

#include <cmath>

#include "referee/pose.hpp"

namespace plumb::harness {

/// Angles about x, then y, then z of the frame around it.
[[nodiscard]] inline referee::Vec3 roll_pitch_yaw(const referee::Mat3& r) {
  const double level = std::hypot(r(0, 0), r(1, 0));
  const bool upright = level < 1e-9;  // then only the sum of the other two is there
  return {upright ? std::atan2(-r(1, 2), r(1, 1)) : std::atan2(r(2, 1), r(2, 2)), std::atan2(-r(2, 0), level),
          upright ? 0 : std::atan2(r(1, 0), r(0, 0))};
}

}  // namespace plumb::harness
