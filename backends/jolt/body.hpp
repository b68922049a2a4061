// A body: Jolt's, and beside it what the interface knows and Jolt does not.
#pragma once

#include "shapes.hpp"

namespace plumb::jolt {

struct Body {
  /// Of a kinematic body: with its velocity, to its target in the next step, or having come there by the last one.
  enum class Moving : std::uint8_t { as_told, to_target, arrived };

  PlumbBody handle = 0;
  JPH::Body* jolt = nullptr;  ///< its user data point back here
  PlumbBodyDesc desc{};       ///< material, filter, damping as they are now
  const Shape* shape = nullptr;
  Moving moving = Moving::as_told;
  PlumbPose target{};
  bool was_asleep = false;  ///< after the step before

  [[nodiscard]] bool is(PlumbMotion motion) const { return desc.motion == motion; }
  [[nodiscard]] bool is_sensor() const { return (desc.flags & PLUMB_BODY_SENSOR) != 0; }
  /// Dynamic, with all axes locked: to Jolt it is kinematic and stands.
  [[nodiscard]] bool is_pinned() const { return is(PLUMB_DYNAMIC) && !jolt->IsDynamic(); }
  [[nodiscard]] bool asleep() const { return is(PLUMB_DYNAMIC) && !jolt->IsActive(); }
  [[nodiscard]] JPH::BodyID id() const { return jolt->GetID(); }
  [[nodiscard]] PlumbPose pose() const { return pose_of(*jolt); }
};

/// Whose body it is.
[[nodiscard]] inline const Body& owner(const JPH::Body& body) {
  return *reinterpret_cast<const Body*>(static_cast<std::uintptr_t>(body.GetUserData()));
}

}  // namespace plumb::jolt
