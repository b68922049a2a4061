// From the interface's joints to the engine's rows.
#pragma once

#include "joints/joint_store.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse {

/// Axes that a joint leaves free, as bits.
[[nodiscard]] std::uint32_t free_axes(const PlumbJointDesc& desc);

struct JointRows {
  JointType type;
  int rows;
  std::uint32_t pulls;  ///< Joint::pulls
  JointAxes axes;
  JointDrive drive;
  bool locks_turns;
};
/// Throws Error where a limit, motor or spring is on an axis that the joint locks.
[[nodiscard]] JointRows rows_of_joint(const PlumbJointDesc& desc);

}  // namespace plumb::impulse
