// A scene as a user names one, with its parameters.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace plumb::harness {

/// By id or file, its first variant but for parameters "name=value". Throws UsageError for several scenes or none.
[[nodiscard]] Scene one_scene(const std::string& name, const std::vector<std::string>& parameters,
                              const Times& times = {});

}  // namespace plumb::harness
