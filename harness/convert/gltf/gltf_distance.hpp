// Limits of all three linear axes together: how far two nodes may be apart.
#pragma once

#include <nlohmann/json.hpp>

#include "convert/imported.hpp"

namespace plumb::harness {

/// Whether a joint has no limits but such ones.
[[nodiscard]] bool is_distance(const nlohmann::json& limits);
/// A soft one at a length is a spring. joint: an entry of physicsJoints.
void set_distance(PlumbJointDesc& desc, const nlohmann::json& joint, const std::string& name, Remarks& remarks);

}  // namespace plumb::harness
