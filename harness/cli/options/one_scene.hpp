// A scene as a user names one, with its parameters.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace plumb::harness {

/// By id or path. Throws UsageError for several scenes or none.
[[nodiscard]] SceneFile one_scene_file(const std::string& name);
/// Its first variant but for parameters "name=value".
[[nodiscard]] Scene one_scene(const SceneFile& file, const std::vector<std::string>& parameters,
                              const Times& times = {});
[[nodiscard]] inline Scene one_scene(const std::string& name, const std::vector<std::string>& parameters) {
  return one_scene(one_scene_file(name), parameters);
}

}  // namespace plumb::harness
