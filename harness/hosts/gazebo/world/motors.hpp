// Limits and motors of a joint's axis as Plumb takes them.
#pragma once

#include "hosts/gazebo/world/entities.hpp"

namespace plumb::gazebo {

[[nodiscard]] PlumbLimit limit_of(const Joint& joint, std::size_t axis);
/// Holds the velocity that was commanded, or resists as dry friction does.
[[nodiscard]] PlumbMotor motor_of(const Joint& joint, std::size_t axis);

}  // namespace plumb::gazebo
