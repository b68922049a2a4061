// What a page calls a scene.
#pragma once

#include <string>

#include "base/json.hpp"

namespace plumb::harness {

/// "D1 H=10": the scene of a trajectory's header with the parameters that tell it from its siblings.
[[nodiscard]] std::string replay_title(const Json& header);

}  // namespace plumb::harness
