// What a joint lets go and what drives it, as limits and drives of KHR_physics_rigid_bodies.
#pragma once

#include "base/json.hpp"
#include "convert/imported.hpp"

namespace plumb::harness {

/// An entry of physicsJoints. Springs by frequency become remarks.
[[nodiscard]] Json joint_description(const SceneJoint& joint, Remarks& remarks);

}  // namespace plumb::harness
