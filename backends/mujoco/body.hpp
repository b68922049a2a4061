// A body: what moves of it, and where it is in the model.
#pragma once

#include <algorithm>
#include <utility>
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

  PlumbPose pose{};              ///< of its frame
  PlumbVec3 velocity{}, spin{};  ///< of the centre of mass; rad/s, world axes
  PlumbVec3 force{}, torque{};   ///< of the host, for the next step
  Moving moving = Moving::as_told;
  PlumbPose target{};
  bool written = true;  ///< pose or velocity are not in MuJoCo's data yet

  // Where it is in the model.
  int id = 0;              ///< of MuJoCo's body
  int root = 0;            ///< id of the tree's root
  Body* parent = nullptr;  ///< null: the world
  Joint* link = nullptr;   ///< to the parent; null: none, it is free or stands still
  bool reversed = false;   ///< the link's body b is the parent
  int first_joint = -1;    ///< of its own in the model
  int joint_count = 0;
  PlumbVec3
      shift{};  ///< of MuJoCo's frame in its own: a free body's stands in the centre of mass, about which it turns

  [[nodiscard]] bool is(PlumbMotion motion) const { return desc.motion == motion; }
  [[nodiscard]] bool is_sensor() const { return (desc.flags & PLUMB_BODY_SENSOR) != 0; }
  /// A frame of ours in MuJoCo's.
  [[nodiscard]] PlumbPose shifted(const PlumbPose& local) const {
    return {sub(local.position, shift), local.orientation};
  }
  [[nodiscard]] PlumbVec3 centre() const { return point_of(pose, centre_of_mass()); }
  /// Linear and angular, of what is not locked.
  [[nodiscard]] std::pair<PlumbVec3, PlumbVec3> free_velocity() const {
    const auto kept = [this](std::uint32_t bit, double v) { return (desc.locks & bit) != 0 ? 0 : v; };
    const bool turns = (desc.flags & PLUMB_BODY_NO_ROTATION) == 0;
    return {{kept(PLUMB_LOCK_LINEAR_X, velocity.x), kept(PLUMB_LOCK_LINEAR_Y, velocity.y),
             kept(PLUMB_LOCK_LINEAR_Z, velocity.z)},
            turns ? PlumbVec3{kept(PLUMB_LOCK_ANGULAR_X, spin.x), kept(PLUMB_LOCK_ANGULAR_Y, spin.y),
                              kept(PLUMB_LOCK_ANGULAR_Z, spin.z)}
                  : PlumbVec3{}};
  }
  /// In its frame. What is not dynamic turns about its origin.
  [[nodiscard]] PlumbVec3 centre_of_mass() const { return is(PLUMB_DYNAMIC) ? desc.centre_of_mass : PlumbVec3{}; }
};

/// Their slots, the lower first.
[[nodiscard]] inline std::pair<std::uint32_t, std::uint32_t> in_order(const Body& a, const Body& b) {
  return std::minmax({slot_of(a.handle), slot_of(b.handle)});
}

}  // namespace plumb::mujoco
