// What the host side knows of a joint beside the engine's rows.
#pragma once

#include "plumb/plumb.h"

namespace plumb::impulse {

struct JointRecord {
  PlumbJoint id = 0;  ///< 0: the slot is free
  PlumbJointDesc desc{};
  bool enabled = true;
  std::uint32_t made_after = 0;  ///< steps that were done when it was made

  [[nodiscard]] bool breaks() const { return desc.break_force > 0 || desc.break_torque > 0; }
};

}  // namespace plumb::impulse
