// A body: what moves of it, and which node of DART's skeletons it is.
#pragma once

#include <dart/dynamics/BodyNode.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "shapes.hpp"

namespace plumb::dart6 {

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
  bool written = true;  ///< pose or velocity are not in DART's coordinates yet

  // Where it is in the skeletons.
  ::dart::dynamics::BodyNode* node = nullptr;
  std::vector<::dart::dynamics::Joint*> joints;  ///< from the parent to it: one for each free axis of the link
  Body* parent = nullptr;                        ///< null: the world
  Joint* link = nullptr;                         ///< to the parent; null: none, it is free or stands still
  bool reversed = false;                         ///< the link's body b is the parent

  [[nodiscard]] bool is(PlumbMotion motion) const { return desc.motion == motion; }
  [[nodiscard]] bool is_sensor() const { return (desc.flags & PLUMB_BODY_SENSOR) != 0; }
  [[nodiscard]] bool turns() const { return (desc.flags & PLUMB_BODY_NO_ROTATION) == 0; }
  /// In its frame. What is not dynamic turns about its origin.
  [[nodiscard]] PlumbVec3 centre_of_mass() const { return is(PLUMB_DYNAMIC) ? desc.centre_of_mass : PlumbVec3{}; }
  [[nodiscard]] PlumbVec3 centre() const { return point_of(pose, centre_of_mass()); }
};

/// Their slots, the lower first.
[[nodiscard]] inline std::pair<std::uint32_t, std::uint32_t> in_order(const Body& a, const Body& b) {
  return std::minmax({slot_of(a.handle), slot_of(b.handle)});
}

}  // namespace plumb::dart6
