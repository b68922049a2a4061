// Rows of a joint's fields, out of what adapters keep of it: its description, where its frames are, its reaction.
// Shared by engines whose bodies are trees of joints; nothing of one engine comes in here.
#pragma once

#include <cstddef>

#include "plumb/backend/joint_coordinates.hpp"
#include "plumb/backend/modify.hpp"

namespace plumb::articulated {

/// row has 12 numbers, of which a field uses the first.
template <class Joint>
void read_joint_row(PlumbJointField field, const Joint& joint, double* row) {
  const auto put = [row](std::size_t first, const PlumbVec3& v) {
    row[first] = v.x;
    row[first + 1] = v.y;
    row[first + 2] = v.z;
  };
  if (field == PLUMB_JOINT_COORDINATES) {
    backend::joint_coordinates(joint.desc.type, joint.frame_a(), joint.frame_b(), row);
    if (joint.desc.type == PLUMB_JOINT_DISTANCE) put(0, {backend::length({row[0], row[1], row[2]}), 0, 0});
  }
  if (field == PLUMB_JOINT_REACTION) {
    put(0, joint.force);
    put(3, joint.torque);
  }
  if (field == PLUMB_JOINT_SPRING_REST) backend::read_rest_row(joint.desc, row);
  for (std::size_t axis = 0; field == PLUMB_JOINT_MOTOR && axis < 6; ++axis) {
    const PlumbMotor& motor = joint.desc.motors[axis];
    row[2 * axis] = motor.target_velocity;
    row[2 * axis + 1] = motor.enabled != 0 ? motor.max_force : 0;
  }
}

/// row: of PLUMB_JOINT_MOTOR.
inline void write_motor_row(const double* row, PlumbJointDesc& desc) {
  for (std::size_t axis = 0; axis < 6; ++axis)
    desc.motors[axis] = {row[2 * axis], row[2 * axis + 1], row[2 * axis + 1] != 0 ? 1u : 0u, 0};
}

}  // namespace plumb::articulated
