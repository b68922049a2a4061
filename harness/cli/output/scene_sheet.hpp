// All that a scene file says, for a terminal.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace plumb::harness {

/// What it sets up and where its truth comes from; needs, steps, parameters, variants, measure, metrics with truths and
/// thresholds, and a line that runs it.
[[nodiscard]] std::string scene_sheet(const SceneFile& file, std::size_t width);

}  // namespace plumb::harness
