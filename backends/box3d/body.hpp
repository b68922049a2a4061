// A body: Box3D's, and beside it what the interface knows and Box3D does not.
#pragma once

#include <vector>

#include "shapes.hpp"

namespace plumb::box3d {

struct Body {
  /// Of a kinematic body: with its velocity, to its target in the next step, or having come there by the last one.
  enum class Moving : std::uint8_t { as_told, to_target, arrived };

  PlumbBody handle = 0;
  b3BodyId id{};
  PlumbBodyDesc desc{};  ///< material, filter, damping as they are now
  const Shape* shape = nullptr;
  std::vector<b3ShapeId> shapes;  ///< Box3D's; of a compound one a child
  Moving moving = Moving::as_told;
  PlumbPose target{};
  bool was_asleep = false;  ///< after the step before

  [[nodiscard]] bool is(PlumbMotion motion) const { return desc.motion == motion; }
  [[nodiscard]] bool is_sensor() const { return (desc.flags & PLUMB_BODY_SENSOR) != 0; }
  [[nodiscard]] bool asleep() const { return is(PLUMB_DYNAMIC) && !b3Body_IsAwake(id); }
  [[nodiscard]] PlumbPose pose() const { return pose_of(b3Body_GetTransform(id)); }
};

/// attach.cpp: gives the body its shapes.
void attach_shapes(Body& body, bool sensed);
/// Brings its material, or its filter, to its shapes.
void apply_material(const Body& body);
void apply_filter(const Body& body);
/// Box3D looks anew at whom the body touches.
void find_pairs_again(const Body& body);

}  // namespace plumb::box3d
