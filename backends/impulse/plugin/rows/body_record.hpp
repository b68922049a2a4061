// What the host side knows of a body beside the engine's rows.
#pragma once

#include <vector>

#include "narrowphase/contact_cache.hpp"
#include "plugin/convert.hpp"

namespace plumb::impulse {

struct BodyRecord {
  PlumbBody id = 0;  ///< 0: the slot is free
  PlumbMotion motion = PLUMB_STATIC;
  bool senses = false;  ///< a sensor
  PlumbMaterial material{};
  PlumbFilter filter{};
  double gravity_scale = 1;
  double linear_damping = 0, angular_damping = 0;
  double rolling_friction = 0, spinning_friction = 0;  ///< m
  /// A kinematic body under way to where the host wants it at the end of the step.
  bool to_target = false, arrived = false;
  PlumbPose target{};
  std::uint32_t shape = kNone;              ///< slot of what it collides as
  std::uint32_t proxy = kNone;              ///< its first
  std::vector<std::uint32_t> more_proxies;  ///< of a compound: the other children's, in their order
};

}  // namespace plumb::impulse
