// A body: what moves of it, and where it is in the model.
#pragma once

#include <vector>

#include "shapes.hpp"

namespace plumb::mujoco {

struct Joint;

struct Body {
  /// Of a kinematic body: with its velocity, to its target in the next step, or having come there by the last one.
  enum class Moving : std::uint8_t { as_told, to_target, arrived };

  PlumbBody handle = 0;
  PlumbBodyDesc desc{};  ///< material, filter, damping as they are now
  const Shape* shape = nullptr;

  PlumbPose pose{};                 ///< of its frame
  PlumbVec3 velocity{}, spin{};     ///< of the centre of mass; rad/s, world axes
  PlumbVec3 force{}, torque{};      ///< of the host, for the next step
  Moving moving = Moving::as_told;
  PlumbPose target{};
  bool written = true;  ///< pose or velocity are not in MuJoCo's data yet

  // Where it is in the model.
  int id = 0;                 ///< of MuJoCo's body
  int root = 0;               ///< id of the tree's root
  Body* parent = nullptr;     ///< null: the world
  Joint* link = nullptr;      ///< to the parent; null: none, it is free or stands still
  bool reversed = false;      ///< the link's body b is the parent
  int first_joint = -1;       ///< of its own in the model
  int joint_count = 0;

  [[nodiscard]] bool is(PlumbMotion motion) const { return desc.motion == motion; }
  [[nodiscard]] bool is_sensor() const { return (desc.flags & PLUMB_BODY_SENSOR) != 0; }
  [[nodiscard]] PlumbVec3 centre() const { return point_of(pose, centre_of_mass()); }
  /// In its frame. What is not dynamic turns about its origin.
  [[nodiscard]] PlumbVec3 centre_of_mass() const { return is(PLUMB_DYNAMIC) ? desc.centre_of_mass : PlumbVec3{}; }
};

}  // namespace plumb::mujoco
