// For backends that have plumb.modify/1.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "plumb/backend/small_math.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// Whether PLUMB_CAP_MODIFY may say that shapes of that type become others.
[[nodiscard]] constexpr bool may_change(PlumbShapeType type) {
  return type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD;
}

/// "motion" of PLUMB_MODIFY_MOTION's index.
[[nodiscard]] constexpr const char* modified_name(std::uint32_t is_joint, std::uint32_t index) {
  constexpr const char* of_bodies[PLUMB_MODIFY_BODY_COUNT] = {"motion", "shape", "mass", "flags", "locks"};
  constexpr const char* of_joints[PLUMB_MODIFY_JOINT_COUNT] = {
      "frames", "limits", "motors", "springs", "strength", "collide_connected", "enabled"};
  if (is_joint == 0) return index < PLUMB_MODIFY_BODY_COUNT ? of_bodies[index] : "unknown member";
  return index < PLUMB_MODIFY_JOINT_COUNT ? of_joints[index] : "unknown member";
}

/// What the body is made of after a change, as the guard fills it; the rest of the descriptor is as body_desc has it.
[[nodiscard]] inline PlumbBodyDesc described(const PlumbBodyChange& change) {
  PlumbBodyDesc desc = body_desc(change.motion);
  desc.flags = change.flags;
  desc.locks = change.locks;
  desc.shape = change.shape;
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = change.mass;
  desc.centre_of_mass = change.centre_of_mass;
  desc.inertia = change.inertia;
  desc.inertia_orientation = change.inertia_orientation;
  return desc;
}

/// Puts what a change names into the joint's descriptor; all but enabled, which no descriptor has.
inline void apply(const PlumbJointChange& change, PlumbJointDesc& desc) {
  const auto changes = [&](std::uint32_t bit) { return (change.what & bit) != 0; };
  if (changes(PLUMB_MODIFY_FRAMES)) {
    desc.frame_a = change.frame_a;
    desc.frame_b = change.frame_b;
  }
  if (changes(PLUMB_MODIFY_LIMITS)) {
    std::copy(std::begin(change.limits), std::end(change.limits), desc.limits);
    if (desc.type == PLUMB_JOINT_DISTANCE) desc.rest_length = change.rest_length;
    if (desc.type == PLUMB_JOINT_GENERIC)
      std::copy(std::begin(change.axis_modes), std::end(change.axis_modes), desc.axis_modes);
  }
  if (changes(PLUMB_MODIFY_MOTORS)) std::copy(std::begin(change.motors), std::end(change.motors), desc.motors);
  if (changes(PLUMB_MODIFY_SPRINGS)) std::copy(std::begin(change.springs), std::end(change.springs), desc.springs);
  if (changes(PLUMB_MODIFY_STRENGTH)) {
    desc.break_force = change.break_force;
    desc.break_torque = change.break_torque;
  }
  if (changes(PLUMB_MODIFY_COLLIDE_CONNECTED)) desc.collide_connected = change.collide_connected;
}

/// Puts a PLUMB_JOINT_MOTOR row that is written into the joint's descriptor: a force switches a motor on, none leaves
/// it.
inline void apply_motor_row(const double* row, PlumbJointDesc& desc) {
  for (PlumbMotor& motor : desc.motors) {
    motor.target_velocity = *row++;
    motor.max_force = *row++;
    if (motor.max_force > 0) motor.enabled = 1;
  }
}

/// Where the spring of a joint's axis rests: of a distance joint that is its length.
[[nodiscard]] inline double& rest_of(PlumbJointDesc& desc, std::size_t axis) {
  return desc.type == PLUMB_JOINT_DISTANCE && axis == 0 ? desc.rest_length : desc.springs[axis].rest;
}
/// A PLUMB_JOINT_SPRING_REST row, from the joint's descriptor and into it.
inline void read_rest_row(PlumbJointDesc desc, double* row) {
  for (std::size_t axis = 0; axis < 6; ++axis) row[axis] = rest_of(desc, axis);
}
inline void apply_rest_row(const double* row, PlumbJointDesc& desc) {
  for (std::size_t axis = 0; axis < 6; ++axis) rest_of(desc, axis) = row[axis];
}

/// Which joints have a body that changes; in a batch of many bodies and many joints, too.
class ChangedBodies {
 public:
  explicit ChangedBodies(std::span<const PlumbBodyChange> changes) : handles_(changes.size()) {
    std::transform(changes.begin(), changes.end(), handles_.begin(), [](const auto& change) { return change.body; });
    std::sort(handles_.begin(), handles_.end());
  }
  [[nodiscard]] bool joined_by(const PlumbJointDesc& joint) const {
    return std::binary_search(handles_.begin(), handles_.end(), joint.body_a) ||
           std::binary_search(handles_.begin(), handles_.end(), joint.body_b);
  }

 private:
  std::vector<PlumbBody> handles_;
};

/// A body's velocity after its centre of mass moved within it by shift (m, world axes): it goes on as it did.
[[nodiscard]] inline PlumbVec3 velocity_of_moved_centre(const PlumbVec3& linear, const PlumbVec3& angular,
                                                        const PlumbVec3& shift) {
  return add(linear, cross(angular, shift));
}

}  // namespace plumb::backend
