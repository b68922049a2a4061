// What the host side knows of a body beside the engine's rows.
#pragma once

#include "plugin/convert.hpp"

namespace plumb::impulse {

struct BodyRecord {
  PlumbBody id = 0;  ///< 0: the slot is free
  PlumbMotion motion = PLUMB_STATIC;
  PlumbMaterial material{};
  PlumbFilter filter{};
  double gravity_scale = 1;
  double linear_damping = 0, angular_damping = 0;
  /// A kinematic body under way to where the host wants it at the end of the step.
  bool to_target = false, arrived = false;
  PlumbPose target{};
};

}  // namespace plumb::impulse
